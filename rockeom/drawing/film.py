"""Frames as an MP4 film, by ffmpeg: the program of the system, or that of imageio-ffmpeg."""

import importlib.util
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path


def ffmpeg() -> str:
    """The program; raises FileNotFoundError, with the remedies, where there is none."""
    if program := shutil.which("ffmpeg"):
        return program
    if importlib.util.find_spec("imageio_ffmpeg") is not None:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    raise FileNotFoundError(
        "an .mp4 film needs ffmpeg, which is not installed: pip install imageio-ffmpeg, install "
        "ffmpeg with the package manager of your system, or write a .gif or .html instead"
    )


def mp4(frames: Iterable[bytes], frames_per_second: float) -> bytes:
    """The film of frames, PNG pictures of one size; H.264, which browsers and slides play.

    Raises OSError with the last words of ffmpeg where that fails.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        command = [
            *(ffmpeg(), "-loglevel", "error", "-f", "image2pipe", "-c:v", "png"),
            *("-framerate", f"{frames_per_second:.6g}", "-i", "-"),
            # H.264 takes even numbers of pixels
            *("-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264"),
            *("-pix_fmt", "yuv420p", "-movflags", "+faststart", str(path)),
        ]
        done = subprocess.run(command, input=b"".join(frames), capture_output=True, check=False)
        if done.returncode:
            said = done.stderr.decode(errors="replace").strip().splitlines()[-1:]
            raise OSError(f"ffmpeg could not make the film: {' '.join(said)}; write a .gif instead")
        return path.read_bytes()
