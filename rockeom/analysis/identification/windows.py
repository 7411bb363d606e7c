"""Spectra of a window that moves along a record; thesis section 4.9.1, Figure 4-50.

from rockeom.analysis import identification

found = identification.moving_window(record, "displacement")                  # a free decay
found = identification.moving_window(record, "displacement", excitation="table")
found.time, found.frequency, found.amplitude, found.dominant
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockeom.analysis.identification.records import MeasuredRecord
from rockeom.numbers.checks import not_negative, positive, require


@dataclass(frozen=True, eq=False)
class MovingWindow:
    """Amplitudes by time and frequency, those of each window over its largest.

    time (m,) [s], of the middle of each window; frequency (k,) [Hz]; amplitude (m, k), at most 1;
    largest (m,), by which each window was divided: of a spectrum in the unit of the channel per
    sqrt(Hz), of a transfer function in that of the channel over that of the excitation.
    span : the length of a window [s]: what changes within it is averaged. bandwidth : of the noise
    that passes one frequency [Hz]: two vibrations nearer than that are one peak.
    transfer : whether it is a transfer function, or the spectrum of the response alone.
    """

    time: np.ndarray
    frequency: np.ndarray
    amplitude: np.ndarray
    largest: np.ndarray
    span: float
    bandwidth: float
    transfer: bool

    @property
    def dominant(self) -> np.ndarray:
        """Frequency of the largest amplitude in each window, (m,) [Hz]."""
        return self.frequency[self.amplitude.argmax(axis=1)]

    def part_above(self, frequency: float) -> np.ndarray:
        """Part of the squared amplitudes of each window that lies above a frequency [Hz], (m,)."""
        square = self.amplitude**2
        return square[:, self.frequency > frequency].sum(axis=1) / square.sum(axis=1)


def moving_window(
    record: MeasuredRecord,
    channel: str,
    excitation: str | None = None,
    *,
    window: float = 0.43,
    step: int = 2,
    segments: int = 1,
    beta: float = 6.0,
    frequencies: tuple[float, float] = (0.0, np.inf),
) -> MovingWindow:
    """Spectrum, or transfer function, of each place of a window that moves along a record.

    channel : the response; excitation : the channel of the ground's acceleration. Each is a Welch
    estimate (scipy.signal) with a Kaiser window: with an excitation |P_xy|/P_xx, the cross spectrum
    over that of the excitation; without, sqrt(P_yy) of the response itself. A free decay has no
    excitation once the table stands: give none there, a quotient by its noise is meaningless.
    window [s], step in samples: 0.43 s and 2 in the thesis, so 86 samples at 200 Hz, and 2.3 Hz at
    best. beta of the Kaiser window, and the number of segments, which lie half over one another,
    are not stated there. One segment resolves best and averages nothing; each further one widens
    the bandwidth. The mean of each segment is subtracted.
    frequencies : the lowest and the highest that are kept [Hz]. They stand eight times as dense as
    the window resolves (zeros are added), which places a peak and separates none.

    Raises ValueError for a window of fewer than 16 samples or longer than the record, and where
    the segments are too short.
    """
    from scipy import signal

    where = "moving_window"
    positive(where, window=window, step=step, segments=segments)
    not_negative(where, beta=beta)
    rate = 1 / record.step
    samples = round(window * rate)
    rule = f"it must hold from 16 samples to all {len(record.time)} of the record"
    require(16 <= samples <= len(record.time), where, "window", window, rule)
    length = 2 * samples // (segments + 1) if segments > 1 else samples
    require(length >= 8, where, "segments", segments, "fewer, or a longer window")
    shape = signal.get_window(("kaiser", beta), length)
    how = {
        "fs": rate, "window": shape, "nperseg": length, "noverlap": length // 2,
        "nfft": 8 * 2 ** int(np.ceil(np.log2(length))), "detrend": "constant",
    }  # fmt: skip

    def windows(name: str) -> np.ndarray:
        return np.lib.stride_tricks.sliding_window_view(record[name], samples)[::step]

    response = windows(channel)
    if excitation is None:
        f, power = signal.welch(response, **how)
        amplitude = np.sqrt(power)
    else:
        f, across = signal.csd(windows(excitation), response, **how)
        power = signal.welch(windows(excitation), **how)[1]
        amplitude = np.abs(across) / np.maximum(power, np.finfo(float).tiny)
    kept = (f >= max(frequencies[0], f[1])) & (f <= frequencies[1])
    largest = amplitude[:, kept].max(axis=1)
    over = np.maximum(largest, np.finfo(float).tiny)
    return MovingWindow(
        time=record.time[0] + (np.arange(len(response)) * step + (samples - 1) / 2) / rate,
        frequency=f[kept],
        amplitude=amplitude[:, kept] / over[:, None],
        largest=largest,
        span=samples / rate,
        bandwidth=float(rate * np.sum(shape**2) / np.sum(shape) ** 2),
        transfer=excitation is not None,
    )
