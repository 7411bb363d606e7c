"""Spectra of a window that moves along a record; thesis section 4.9.1, Figure 4-50.

from rockeom.analysis import identification

found = identification.moving_window(record, "displacement")                  # a free decay
found = identification.moving_window(record, "displacement", excitation="table")
found.time, found.frequency, found.amplitude, found.dominant
"""

from dataclasses import dataclass

import numpy as np

from rockeom.analysis.identification.records import MeasuredRecord
from rockeom.numbers.checks import not_negative, positive, require


@dataclass(frozen=True, eq=False)
class MovingWindow:
    """Amplitudes by time and frequency, those of each window over its largest.

    Parameters
    ----------
    time : ndarray
        Middle of each window (m,) [s].
    frequency : ndarray
        Frequencies (k,) [Hz].
    amplitude : ndarray
        Amplitudes (m, k), at most 1.
    largest : ndarray
        Largest amplitude (m,), by which each window was divided: of a spectrum in the unit of the
        channel per sqrt(Hz), of a transfer function in that of the channel over that of the
        excitation.
    span : float
        Length of a window [s]: changes within it are averaged.
    bandwidth : float
        Bandwidth of the noise that passes one frequency [Hz]: two vibrations nearer than that are
        one peak.
    transfer : bool
        Whether it is a transfer function, or the spectrum of the response alone.
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
        """Part of the squared amplitudes of each window that lies above a frequency.

        Parameters
        ----------
        frequency : float
            Frequency [Hz].

        Returns
        -------
        ndarray
            Parts (m,).
        """
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

    Parameters
    ----------
    record : MeasuredRecord
        Record of a test.
    channel : str
        Channel of the response.
    excitation : str, optional
        Channel of the ground's acceleration. A free decay has no excitation once the table stands:
        give none there, a quotient by its noise is meaningless.
    window : float, optional
        Length of the window [s]; 0.43 s in the thesis, so 86 samples at 200 Hz, and 2.3 Hz at best.
    step : int, optional
        Number of samples by which the window moves; 2 in the thesis.
    segments : int, optional
        Number of segments, which lie half over one another; not stated in the thesis. One segment
        resolves best and averages nothing; each further one widens the bandwidth.
    beta : float, optional
        Parameter of the Kaiser window; not stated in the thesis.
    frequencies : tuple of (float, float), optional
        Lowest and highest frequency of the result [Hz].

    Returns
    -------
    MovingWindow
        Amplitudes by time and frequency.

    Raises
    ------
    ValueError
        For a window of fewer than 16 samples or longer than the record, and where the segments are
        too short.

    Notes
    -----
    Each is a Welch estimate (scipy.signal) with a Kaiser window: with an excitation
    ``|P_xy|/P_xx``, the cross spectrum over that of the excitation; without, ``sqrt(P_yy)`` of the
    response itself. The mean of each segment is subtracted. The frequencies stand eight times as
    dense as the window resolves (zeros are added), which places a peak and separates none.
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
