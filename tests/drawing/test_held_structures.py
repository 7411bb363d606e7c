"""Sketches of structures that are held: coordinates of what is drawn, by hand."""

import numpy as np
import pytest

import rockeom as rk
from rockeom.drawing.style import full_contact
from rockeom.plots import animate, draw_structure
from tests.contact.test_facade import SIZE as FACADE, TIE
from tests.contact.test_held_block import FINE, PULSE, SIZE
from tests.contact.test_isolated_blocks import BLOCK, isolated

STRAP = {"at": (-0.25, 1.6), "to": (-0.7, 1.6), "stiffness": 1e5, "pretension": 100.0}
ANCHORED = rk.HeldBlock(**SIZE, restraint=rk.Anchor.pair(stiffness=1e6))
ROUND = rk.HeldBlock(**(SIZE | {"height": 0.8}), base_radius=1.0)
TIED = rk.Facade(**FACADE, restraint=rk.Strap(**TIE))
TURN = 0.04
C, S = np.cos(TURN), np.sin(TURN)


def strapped(force):
    return rk.HeldBlock(**SIZE, restraint=rk.Strap(**STRAP, breaks_at=rk.Break(force=force)))


def on_block(x, y, side=1):
    """A point of the block that leans by TURN on a foot, the middle of its base above x = 0."""
    return np.array([C * x + side * S * y, 0.25 * S - side * S * x + C * y])


def seen(ax, dashed=False):
    """Coordinates (n, 2) of lines and faces as they are seen."""
    parts = [(one, one.get_xydata()) for one in ax.lines if (one.get_ls() == "--") == dashed]
    parts += [(one, one.get_xy()) for one in ax.patches]
    return [(one.get_transform() - ax.transData).transform(points) for one, points in parts]


AT, TO, FOOT = on_block(*STRAP["at"]), np.array(STRAP["to"]), on_block(-0.25, 0.0)
GAP = 0.4 * (TO - AT)
BEHIND = 0.3 - 0.6 * C + 5.5 * S, 0.6 * S + 5.5 * C  # about the edge (0.3, 0)
DRAWN = {
    "tight strap": (strapped(8e3), {"theta": TURN}, [(AT, TO)]),
    "slack strap": (strapped(8e3), {"theta": -TURN}, [(on_block(*STRAP["at"], -1), TO)]),
    "broken strap": (
        strapped(1e3), {"theta": TURN, "strap_broken": 1.0}, [(AT, AT + GAP), (TO - GAP, TO)]
    ),
    "anchor": (ANCHORED, {"theta": TURN}, [(FOOT, (FOOT[0], 0.0))]),
    "facade": (TIED, {"theta": TURN}, [(BEHIND, TIE["to"]), ((-0.3, 0.0), (-0.3, 6.0))]),
    "round base": (ROUND, {"theta": TURN}, [[(S, 0.0)]]),
    "slab and block": (isolated(BLOCK), {"u": 0.1}, [
        [(-0.275, -0.0625), (0.475, -0.0625), (0.475, 0.0), (-0.275, 0.0), (-0.275, -0.0625)],
        [(-0.15, 0.0), (0.35, 0.0), (0.35, 1.8), (-0.15, 1.8), (-0.15, 0.0)],
    ]),
    "ground under bearings": (isolated(BLOCK), {"u": 0.1}, [[(0.375 * 0.75, -0.125)]]),
}  # fmt: skip


@pytest.mark.parametrize("slope", [0.0, 0.1])
@pytest.mark.parametrize("name", DRAWN)
def test_parts_are_drawn_where_they_are_by_hand(name, slope):
    structure, state, wanted = DRAWN[name]
    (ax,) = draw_structure(structure, state=state, slope=slope).axes
    c, s = np.cos(slope), np.sin(slope)
    for points in np.array(wanted) @ np.array([[c, -s], [s, c]]):
        parts = seen(ax, dashed=name == "slack strap")
        assert any(len(one) == len(points) and np.allclose(one, points) for one in parts)


@pytest.mark.parametrize("structure", [ROUND, rk.HeldBlock(**SIZE, corner_radius=0.08)])
def test_arcs_are_drawn_as_polygons_that_stand_on_the_ground(structure):
    (face,) = draw_structure(structure, state={"theta": 0.2}).axes[0].patches
    assert 0.0 <= face.get_xy()[:, 1].min() < 5e-4


@pytest.mark.parametrize(("time", "to_come"), [(0.0, 2.0), (0.3, 1.5), (0.6, 0.0)])
def test_a_push_has_an_arrow_while_it_acts_and_its_impulse_on_a_slope_without_friction(
    time, to_come
):
    push = rk.Push(at=(0.1, 1.2), force=-90.0, duration=0.3, start=0.2)
    pushed = rk.HeldBlock(**(SIZE | {"friction": 0.0}), loads=push)
    start = {"push_time": time} if time else None
    arrows = draw_structure(pushed, state=start).axes[0].texts
    wanted = [((0.1, 1.2), True)] * (time == 0.3)
    assert [(arrow.xy, arrow.xyann[0] > 0.1) for arrow in arrows] == wanted
    run = rk.simulate(pushed, rk.GroundMotion.none(0.5), initial=start, slope=0.1)
    speed = 0.5 * 9.81 * np.sin(0.1) - 90.0 * 0.3 / np.pi * to_come / 300.0
    assert run.final["x_dot"] == pytest.approx(speed)
    assert run["ground_work"][-1] + run["force_work"][-1] == pytest.approx(150.0 * speed**2)


def test_forces_have_no_moment_about_the_contact_of_a_round_base_which_ends_at_its_edge():
    run = rk.simulate(ROUND, PULSE, options=FINE)
    assert abs(run["overturning_moment"]).max() < 1e-6 * 300.0 * 9.81 * 0.4
    over = rk.simulate(ROUND, PULSE, initial={"theta": 0.24, "theta_dot": 0.5})
    assert (over.outcome, over.final["theta"]) == ("overturned", pytest.approx(np.arcsin(0.25)))


def test_a_block_stands_in_full_contact_away_from_a_wall():
    run = rk.simulate(rk.HeldBlock(**SIZE, wall_gap=0.1), rk.GroundMotion.none(0.5))
    assert full_contact(run).tolist() == [[0.0, 0.5]]


def test_a_film_shows_the_strap_until_it_breaks_and_its_force():
    run = rk.simulate(strapped(1e3), PULSE.scaled(2.0))
    broke_at = run.ties["strap"].broke_at
    ax = next(ax for ax in run.plot().axes if "force of ties" in ax.get_ylabel())
    assert ax.lines[-1].get_xydata()[0] == pytest.approx([broke_at, 1e3])
    film = animate(run, frames_per_second=10.0)
    for i, gaps in ((int(10 * broke_at), 0), (int(10 * broke_at) + 1, 1)):
        ax.clear()
        film.draw(i, ax)
        ends = [one for one in seen(ax) if np.allclose(one[-1], TO) and one[0, 0] < -0.5]
        assert len(ends) == gaps
