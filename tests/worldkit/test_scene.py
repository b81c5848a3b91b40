import mujoco
import numpy as np
import pytest

from worldkit import materials, scene
from worldkit.materials import LOOKS
from worldkit.settings import SETTINGS


@pytest.mark.parametrize("setting", SETTINGS)
def test_every_setting_compiles_with_a_ground_at_zero(setting):
    model = scene.new("empty", time_step=0.002, setting=setting).compile()
    ground = model.geom("ground")
    assert model.geom_type[ground.id] == mujoco.mjtGeom.mjGEOM_PLANE
    assert ground.pos[2] == 0 and model.geom_size[ground.id, 0] == 0
    assert model.vis.global_.offwidth >= 1920 and model.vis.global_.offheight >= 1080
    assert model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    assert model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_ENERGY


def test_options_are_as_asked():
    spec = scene.new("moon", time_step=0.004, gravity=(0, 0, -1.62), integrator="rk4", floor="sand")
    model = spec.compile()
    assert model.opt.timestep == 0.004 and model.opt.gravity[2] == -1.62
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    assert spec.modelname == "moon"
    assert model.mat(int(model.geom("ground").matid[0])).name == "sand"


def test_the_floor_takes_its_contact_properties():
    model = scene.new("x", time_step=0.002, floor_surface={"friction": (0.9, 0.01, 0.002), "condim": 6}).compile()
    assert np.allclose(model.geom("ground").friction, (0.9, 0.01, 0.002)) and model.geom("ground").condim == 6


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"setting": "underwater"}, r"setting.*underwater.*studio"),
        ({"integrator": "verlet"}, r"integrator.*verlet.*implicitfast"),
        ({"time_step": 0.0}, "time step"),
        ({"floor": "wood_oke"}, "wood_oak"),
    ],
)
def test_wrong_options_name_the_right_ones(options, message):
    with pytest.raises(ValueError, match=message):
        scene.new("x", **{"time_step": 0.002} | options)


def test_a_look_is_added_once_and_shared():
    spec = mujoco.MjSpec()
    assert materials.add(spec, "wood_oak") == materials.add(spec, "wood_oak") == "wood_oak"
    assert [m.name for m in spec.materials] == ["wood_oak"] and len(spec.textures) == 1


def test_a_colour_is_a_look():
    spec = mujoco.MjSpec()
    name = materials.add(spec, "#3366ff")
    spec.worldbody.add_geom(size=(1, 0, 0), material=name)
    model = spec.compile()
    assert np.allclose(model.mat_rgba[0], (0.2, 0.4, 1.0, 1.0), atol=1e-6)


@pytest.mark.parametrize(
    ("wrong", "right"), [("wood_oka", "wood_oak"), ("green felt", "felt_green"), ("#12345", "#3a7bd5")]
)
def test_an_unknown_look_names_the_nearest(wrong, right):
    with pytest.raises(ValueError, match=right):
        materials.add(mujoco.MjSpec(), wrong)


def test_the_library_is_described_and_complete():
    asked = """
        wood_oak wood_walnut wood_planks felt_green felt_blue phenolic_white phenolic_red phenolic_yellow phenolic_black
        rubber_black rubber_orange ceramic_white ceramic_blue marble_white steel_brushed chrome brass copper glass_clear
        plastic_red plastic_blue plastic_white leather_brown fabric_linen paper cardboard concrete brick grass sand asphalt
        stone ice apple_red
    """
    asked = asked.split()
    assert set(asked) <= set(LOOKS)
    assert all(8 <= len(description) <= 80 for description in LOOKS.values())
