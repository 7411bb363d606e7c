"""Speed and accuracy beside a hand-written C program, heyoka and SciPy, on the same work.

python -m benchmarks                  all workloads: errors, times, ratios to C
python -m benchmarks W1 W4 --quick    some of them, with few repetitions
python -m benchmarks.precision        error against time of each method, out/precision.png
python -m benchmarks.reference        the references of 30 digits anew (minutes)
"""
