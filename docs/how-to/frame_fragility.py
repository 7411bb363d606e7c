"""A frame of three storeys that may rock, under the 44 far-field components of FEMA P695."""
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
import xarray as xr
import rockeom as rk
from rockeom.symbolic import Body, Spring, coordinate, parameter, rocking_structure, turned

units = {"mass": "kg", "height": "m", "stiffness": "N/m", "damping": "N s/m", "half_width": "m", "gravity": "m/s2"}
parameters = [parameter(name, name, unit, f"{name}, of each storey") for name, unit in units.items()]
m, h, k, c, b, g = (p.symbol for p in parameters)
theta = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
floors = [coordinate(f"u_{i}", f"u{i}", "m", f"displacement of floor {i}") for i in (1, 2, 3)]
u = [0, *(floor.position for floor in floors)]
model = rocking_structure(
    name="three_storeys", title="Frame of three storeys", parameters=parameters, half_width=b, gravity=g,
    coordinates=[theta, *floors],
    bodies=lambda pivot: [Body(f"floor {i}", m, turned((u[i], i * h), pivot, theta.position), rotation=theta.position) for i in (3, 2, 1, 0)],
    elements=[Spring(f"storey_{i}", u[i] - u[i - 1], k, c) for i in (1, 2, 3)],
)
frame = rk.structure(model, mass=20e3, height=3.5, stiffness=20e6, damping=120e3, half_width=1.6)
asked = [f"floor_{i}_acceleration" for i in (1, 2, 3)] + [f"storey_{i}_deformation" for i in (1, 2, 3)] + ["left_uplift"]
def scaled(motion, pga): return rk.Case(frame, motion.scaled_to(pga), impact=rk.Impulsive())  # m/s2
if __name__ == "__main__":
    if not Path("frame.nc").exists():
        over = {"motion": [*rk.MotionSet.from_library("far field")], "pga": [float(a) for a in range(1, 11)]}
        rk.simulate_many(scaled, over, quantities=asked, executor=ProcessPoolExecutor()).to_netcdf("frame.nc")
    sweep = xr.open_dataset("frame.nc")  # the second time in a new process
    rk.plots.incremental_dynamic_analysis(sweep, intensity="pga", demand="storey_1_deformation").savefig("ida.png")
    rk.plots.fragility_curve(sweep, intensity="pga", demand="storey_1_deformation", limit=0.015).savefig("fragility.png")
