"""Speed and accuracy beside a hand-written C program, heyoka and SciPy, on the same work.

python -m benchmarks                  all workloads: errors, times, ratios; out/bench.md, bench.json
python -m benchmarks W1 W4 --quick    some of them, with few repetitions
python -m benchmarks --write docs/benchmarks.md
python -m benchmarks --read out/bench.json --write docs/benchmarks.md   of an earlier run
python -m benchmarks.first_call       what the first simulation of each structure costs
python -m benchmarks.derivation COMMIT   derivations beside a former commit (minutes)
python -m benchmarks.lanes            maps of many motions, in lanes and one by one
python -m benchmarks.gradient         a gradient by ten parameters, in runs of the motion
python -m benchmarks.precision        error against time of each method, out/precision.png
python -m benchmarks.convergence      orders of convergence through impacts
python -m benchmarks.reference        the references of 30 digits anew (minutes)
python -m benchmarks.crosscheck       joints and springs by OpenSees, Exudyn and MuJoCo
python -m benchmarks.reference_cases  twenty motions for other programs, found twice (minutes)
python -m benchmarks.engines          those motions by other programs (minutes)
python -m benchmarks.in_space         bodies in space, other programs too (minutes)
python -m benchmarks.plane_or_space   forty objects in the plane and in space (minutes)
python -m benchmarks.azimuths         how often intervals of shares over azimuths hold (minutes)

workloads says what is done; with_c, with_best_c, with_rockeom, with_heyoka and with_scipy do it;
ways lists the settings that are tried.
"""
