"""The slender block under one sine, exactly.

x = theta/alpha in the time tau = p t obeys x'' = x - s + A sin(w tau), s = +1 or -1 the side to
which it leans; what the ground does first is called positive. Between impacts
x = s - A sin(w tau)/(1 + w^2) + c e^tau + d e^-tau, where the sine is left out once the pulse is
over. The block then falls if s (x - s + x') > 0.
"""

import numpy as np


class Swing:
    """From time tau, place x and rate v (n,) on, to the side s, under sines of size a (or none)."""

    def __init__(self, tau, x, v, s, a, w):
        self.tau, self.s, self.w, self.size = tau, s, w, a / (1 + w**2)
        rest = x - s + self.size * np.sin(w * tau)
        rate = v + self.size * w * np.cos(w * tau)
        self.grows, self.decays = (rest + rate) / 2, (rest - rate) / 2

    def at(self, tau):
        up, down = np.exp(tau - self.tau), np.exp(self.tau - tau)
        x = self.s - self.size * np.sin(self.w * tau) + self.grows * up + self.decays * down
        v = -self.size * self.w * np.cos(self.w * tau) + self.grows * up - self.decays * down
        return x, v

    def upright(self, until, samples=600):
        """The first time at which it comes upright, nan where it does not."""
        low, high = self.tau.copy(), np.full_like(self.tau, np.nan)
        for k in range(1, samples + 1):
            tau = self.tau + (until - self.tau) * k / samples
            back = np.isnan(high) & (self.s * self.at(tau)[0] < 0)
            high[back] = tau[back]
            low = np.where(np.isnan(high), tau, low)
        for _ in range(60):
            middle = (low + high) / 2
            beyond = self.s * self.at(middle)[0] < 0
            low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
        return high


def exact_fates(w, a, e, most=3):
    """Impacts before overturning of pulses of frequencies w and sizes a (n,), inf for none.

    e : ratio of the rates of rotation at an impact. most : so many impacts and more are one fate.
    """
    fate = np.full(len(w), np.nan)
    fate[a <= 1] = np.inf
    tau = np.arcsin(1 / np.maximum(a, 1)) / w
    x, v, s = np.zeros_like(w), np.zeros_like(w), np.ones_like(w)
    for impacts in range(30):
        open_ = np.isnan(fate)
        end = 2 * np.pi / w
        swing = Swing(tau, x, v, s, a, w)
        hit = swing.upright(end)
        over = open_ & np.isnan(hit)  # the pulse ends first: from there on the motion is free
        x1, v1 = swing.at(end)
        falls = s * (x1 - s + v1) > 0
        speed = np.sqrt(np.maximum(v1**2 - (x1 - s) ** 2 + 1, 0))  # at the impact that comes
        later = over & ~falls
        fate[over & falls] = min(impacts, most)
        fate[later] = np.where(e * speed[later] > 1, min(impacts + 1, most), np.inf)
        tau, v = hit, e * swing.at(hit)[1]
        x, s = np.zeros_like(w), -s
        if not np.isnan(fate).any():
            return fate
    raise AssertionError("a block chatters under the pulse")
