"""The library of looks, by family. Colours are sRGB."""

from .look import Look
from .metals import bare

OAK = ((0.74, 0.605, 0.445), (0.61, 0.465, 0.32), (0.44, 0.31, 0.20))
WALNUT = ((0.50, 0.34, 0.22), (0.37, 0.235, 0.145), (0.22, 0.13, 0.08))
PINE = ((0.90, 0.76, 0.55), (0.83, 0.66, 0.43), (0.68, 0.47, 0.26))
MAPLE = ((0.90, 0.79, 0.62), (0.84, 0.70, 0.51), (0.72, 0.55, 0.36))
CHERRY = ((0.66, 0.38, 0.24), (0.56, 0.29, 0.17), (0.40, 0.18, 0.10))
EBONY = ((0.19, 0.16, 0.14), (0.13, 0.105, 0.095), (0.07, 0.055, 0.05))


HANDLED, CAST = 1.8, 2.4
"""How many times light meets a coloured metal in use, which is not as pale as a fresh one, and one in the pores of a casting: by
eye, since nothing measured tells it."""


def _wood(description: str, name: str, tones: tuple, rings: float = 26.0, pore: float = 0.5) -> Look:
    return Look(
        description, paint="wood.solid", arguments=(name, *tones, rings, pore), tile_m=0.5, grain=True,
        apart=0.22, roughness=0.38, coat=0.25, relief_m=0.0006, worn_m=0.005,
    )  # fmt: skip


def _pool(description: str, tone: tuple[float, float, float], number: str, striped: bool = False) -> Look:
    return Look(
        description, paint="around.pool", arguments=(tone, number, striped), around=True, roughness=0.09, coat=0.6
    )


def _plastic(description: str, rgb: tuple[float, float, float]) -> Look:
    return Look(description, rgba=(*rgb, 1.0), roughness=0.30, coat=0.12, mark=True)


def _ceramic(description: str, rgb: tuple[float, float, float]) -> Look:
    return Look(
        description, paint="fibre.worn", arguments=(f"ceramic{rgb}", rgb, 0.12), tile_m=0.25, roughness=0.16, coat=0.7
    )


def _metal(description: str, metal: str, roughness: float, met: float = 1.0) -> Look:
    return Look(description, rgba=(*bare(metal, met), 1.0), roughness=roughness, metallic=1.0)


def _painted(description: str, rgb: tuple[float, float, float], beneath: tuple[float, float, float]) -> Look:
    return Look(
        description, paint="fibre.worn", arguments=(f"paint{rgb}", rgb, 0.8), tile_m=0.4, roughness=0.36, coat=0.18,
        worn_m=0.006, beneath=beneath,
    )  # fmt: skip


def _felt(description: str, rgb: tuple[float, float, float]) -> Look:
    return Look(
        description, paint="fibre.felt", arguments=(f"felt{rgb}", rgb), tile_m=0.22, roughness=0.95, sheen=0.35,
        relief_m=0.0004, vary=0.10,
    )  # fmt: skip


PRIMER, BARE_PINE = (0.41, 0.40, 0.385), (0.76, 0.60, 0.40)

POOL_TONES = {
    "yellow": ((0.93, 0.68, 0.06), "1", "9"),
    "blue": ((0.03, 0.14, 0.52), "2", "10"),
    "red": ((0.72, 0.03, 0.04), "3", "11"),
    "purple": ((0.25, 0.07, 0.38), "4", "12"),
    "orange": ((0.90, 0.33, 0.03), "5", "13"),
    "green": ((0.01, 0.33, 0.16), "6", "14"),
    "maroon": ((0.38, 0.03, 0.06), "7", "15"),
}

LIBRARY: dict[str, Look] = {
    "wood_oak": _wood("Oiled oak, golden brown, straight grain", "oak", OAK),
    "wood_walnut": _wood("Dark walnut, satin", "walnut", WALNUT),
    "wood_pine": _wood("Pale pine with amber rings", "pine", PINE, 16.0, 0.15),
    "wood_maple": _wood("Light maple, fine grain", "maple", MAPLE, 20.0, 0.12),
    "wood_cherry": _wood("Reddish cherry", "cherry", CHERRY, 24.0, 0.25),
    "wood_ebony": _wood("Nearly black ebony", "ebony", EBONY, 34.0, 0.3),
    "wood_planks": Look(
        "Varnished oak floor boards", paint="wood.planks", arguments=("planks", *OAK, 16), tile_m=2.0,
        roughness=0.30, coat=0.35, relief_m=0.0016, vary=0.10,
    ),
    "wood_planks_dark": Look(
        "Dark walnut floor boards", paint="wood.planks", arguments=("planks dark", *WALNUT, 16), tile_m=2.0,
        roughness=0.30, coat=0.35, relief_m=0.0016, vary=0.10,
    ),
    "wood_planks_pale": Look(
        "Pale, limed floor boards", paint="wood.planks",
        arguments=("planks pale", (0.83, 0.77, 0.68), (0.74, 0.66, 0.56), (0.58, 0.49, 0.40), 16, 0.7),
        tile_m=2.0, roughness=0.42, coat=0.15, relief_m=0.0016, vary=0.10,
    ),
    "wood_court": Look(
        "Glossy maple sports floor", paint="wood.planks", arguments=("court", (0.74, 0.59, 0.40), (0.665, 0.50, 0.32), (0.54, 0.375, 0.22), 28, 0.6, 0.03), tile_m=1.8,
        roughness=0.26, coat=0.40, relief_m=0.0006, vary=0.06,
    ),
    "felt_green": _felt("Green billiard cloth", (0.028, 0.265, 0.150)),
    "felt_blue": _felt("Blue tournament billiard cloth", (0.045, 0.215, 0.42)),
    "felt_red": _felt("Burgundy billiard cloth", (0.44, 0.06, 0.10)),
    "felt_grey": _felt("Grey wool felt", (0.42, 0.42, 0.43)),
    "phenolic_white": Look("Cue ball: ivory gloss with six red spots", paint="around.cue", around=True, roughness=0.09, coat=0.6),
    "phenolic_black": _pool("The eight ball: black gloss", (0.025, 0.025, 0.03), "8"),
    **{f"phenolic_{n}": _pool(f"Solid {n} pool ball, number {solid}", tone, solid) for n, (tone, solid, _) in POOL_TONES.items()},
    **{f"phenolic_stripe_{n}": _pool(f"Striped {n} pool ball, number {band}", tone, band, True) for n, (tone, _, band) in POOL_TONES.items()},
    "rubber_orange": Look(
        "Basketball: pebbled orange rubber with black seams", paint="around.basketball",
        arguments=((0.80, 0.34, 0.11), (0.055, 0.045, 0.04)), around=True, roughness=0.55, sheen=0.1, relief_m=0.0012,
    ),
    "rubber_black": Look(
        "Matt black rubber", paint="fibre.worn", arguments=("rubber", (0.075, 0.075, 0.08), 2.0), tile_m=0.12,
        roughness=0.68, relief_m=0.0003, mark=True,
    ),
    "rubber_red": Look(
        "Soft red rubber", paint="fibre.worn", arguments=("rubber red", (0.70, 0.09, 0.08), 1.2), tile_m=0.12,
        roughness=0.55, relief_m=0.0003, mark=True,
    ),
    "football": Look("Classic football, black pentagons on white", paint="around.football", around=True, roughness=0.32, coat=0.3, relief_m=0.002),
    "tennis_ball": Look("Yellow-green felt with a white seam", paint="around.tennis", around=True, roughness=0.95, sheen=0.5, relief_m=0.0008),
    "beach_ball": Look("Inflated vinyl in six coloured gores", paint="around.beach", around=True, roughness=0.22, coat=0.4),
    "ball_red": Look("Red play ball with a white band", paint="around.banded", arguments=((0.80, 0.08, 0.08), (0.96, 0.95, 0.92)), around=True, roughness=0.30, coat=0.2),
    "ball_blue": Look("Blue play ball with a yellow band", paint="around.banded", arguments=((0.06, 0.24, 0.66), (0.97, 0.80, 0.16)), around=True, roughness=0.30, coat=0.2),
    "ball_green": Look("Green play ball with a white band", paint="around.banded", arguments=((0.08, 0.50, 0.24), (0.96, 0.95, 0.92)), around=True, roughness=0.30, coat=0.2),
    "ceramic_white": _ceramic("Glazed white porcelain", (0.93, 0.925, 0.90)),
    "ceramic_blue": _ceramic("Cobalt glazed stoneware", (0.09, 0.25, 0.55)),
    "ceramic_green": _ceramic("Celadon glaze", (0.50, 0.66, 0.55)),
    "ceramic_terracotta": Look("Unglazed red clay", paint="fibre.worn", arguments=("terracotta", (0.72, 0.36, 0.23), 1.6), tile_m=0.3, roughness=0.85, relief_m=0.0004, apart=0.1, worn_m=0.004),
    "tiles_white": Look("White glazed tiles with grey joints", paint="masonry.tiles", arguments=("tiles", (0.90, 0.90, 0.88), (0.55, 0.54, 0.52)), tile_m=0.8, roughness=0.15, coat=0.6, relief_m=0.0015),
    "tiles_chequer": Look("Black and cream chequered tiles", paint="masonry.tiles", arguments=("chequer", (0.88, 0.85, 0.78), (0.42, 0.40, 0.38), 4, (0.10, 0.10, 0.11)), tile_m=1.2, roughness=0.18, coat=0.5, relief_m=0.001),
    "marble_white": Look("Polished white marble with grey veins", paint="stone.marble", arguments=("carrara", (0.94, 0.935, 0.925), (0.84, 0.845, 0.85), (0.40, 0.41, 0.44)), tile_m=1.1, roughness=0.12, coat=0.6, apart=0.04, worn_m=0.003),
    "marble_black": Look("Polished black marble with white veins", paint="stone.marble", arguments=("marquina", (0.055, 0.055, 0.06), (0.10, 0.10, 0.105), (0.80, 0.79, 0.76)), tile_m=1.1, roughness=0.12, coat=0.6),
    "granite": Look("Polished grey granite", paint="stone.granite", arguments=("granite", (0.56, 0.55, 0.54), (0.36, 0.35, 0.35), (0.16, 0.155, 0.15)), tile_m=0.45, roughness=0.2, coat=0.4, apart=0.1, worn_m=0.003),
    "slate": Look("Dark split slate", paint="stone.concrete", arguments=("slate", (0.21, 0.225, 0.24), 1.0), tile_m=1.2, roughness=0.55, relief_m=0.002, vary=0.06, apart=0.12, worn_m=0.005),
    "concrete": Look("Smooth trowelled concrete", paint="stone.concrete", arguments=("concrete", (0.63, 0.62, 0.60)), tile_m=1.8, roughness=0.60, relief_m=0.0012, vary=0.10, apart=0.07, worn_m=0.008),
    "plaster": Look("Warm white wall plaster", paint="stone.concrete", arguments=("plaster", (0.90, 0.885, 0.86), 0.12), tile_m=1.6, roughness=0.9, relief_m=0.0006),
    "backdrop": Look("Seamless warm grey studio floor", paint="stone.concrete", arguments=("backdrop", (0.71, 0.685, 0.655), 0.22), tile_m=2.4, roughness=0.48, coat=0.10, vary=0.04),
    "stone": Look("Irregular sandstone paving", paint="stone.slabs", arguments=("stone", (0.74, 0.69, 0.60), (0.50, 0.46, 0.40), (0.40, 0.38, 0.34)), tile_m=1.8, roughness=0.8, relief_m=0.010, vary=0.12, apart=0.1),
    "asphalt": Look("Road asphalt", paint="stone.asphalt", arguments=("asphalt", (0.27, 0.27, 0.275)), tile_m=0.6, roughness=0.85, relief_m=0.003, vary=0.2),
    "brick": Look("Red brick in running bond", paint="masonry.bricks", arguments=("brick", (0.66, 0.33, 0.23), (0.43, 0.19, 0.135), (0.66, 0.62, 0.56)), tile_m=0.66, roughness=0.85, relief_m=0.006, apart=0.2, worn_m=0.008),
    "sand": Look("Pale beach sand", paint="stone.sand", arguments=("sand", (0.90, 0.79, 0.60), (0.70, 0.57, 0.39)), tile_m=1.3, roughness=0.95, relief_m=0.008, vary=0.15),
    "soil": Look("Dark garden soil", paint="stone.asphalt", arguments=("soil", (0.33, 0.235, 0.165)), tile_m=0.5, roughness=0.95, relief_m=0.006, vary=0.25),
    "grass": Look("Mown lawn", paint="stone.grass", arguments=("grass", (0.46, 0.51, 0.26), (0.29, 0.36, 0.15), (0.11, 0.15, 0.06)), tile_m=1.1, roughness=0.92, sheen=0.25, relief_m=0.02, vary=0.16),
    "snow": Look("Fresh snow", paint="stone.sand", arguments=("snow", (0.97, 0.975, 0.99), (0.86, 0.89, 0.95)), tile_m=1.7, roughness=0.85, sheen=0.2, relief_m=0.006, vary=0.04),
    "ice": Look("Frozen lake", paint="stone.ice", arguments=("ice",), tile_m=2.2, roughness=0.10, coat=0.6, relief_m=0.0006, vary=0.05),
    "water": Look("Open water with small ripples, as seen from above it", paint="nature.water", arguments=("water", (0.035, 0.115, 0.135), (0.085, 0.215, 0.215)), tile_m=7.0, roughness=0.04, coat=1.0, relief_m=0.035, vary=0.10),
    "leaves": Look("Foliage of a tree or hedge", paint="nature.leaves", arguments=("leaves", (0.46, 0.56, 0.20), (0.22, 0.36, 0.10), (0.045, 0.10, 0.025)), tile_m=0.9, roughness=0.75, sheen=0.3, relief_m=0.06, vary=0.2, apart=0.2),
    "foliage": Look("Leaves of a tree, many at once: light comes through them", rgba=(0.29, 0.42, 0.145, 1.0), roughness=0.55, thin=0.55),
    "foliage_young": Look("Young leaves of a tree, lighter: light comes through them", rgba=(0.43, 0.55, 0.17, 1.0), roughness=0.5, thin=0.65),
    "foliage_dark": Look("Leaves deep in a crown, where little light comes: light comes through them", rgba=(0.17, 0.27, 0.085, 1.0), roughness=0.6, thin=0.4),
    "foliage_gold": Look("Autumn leaves, yellow: light comes through them", rgba=(0.74, 0.55, 0.12, 1.0), roughness=0.6, thin=0.55),
    "foliage_rust": Look("Autumn leaves, orange to red: light comes through them", rgba=(0.62, 0.27, 0.08, 1.0), roughness=0.6, thin=0.5),
    "leaf_green": Look("One green leaf, seen from near: a net of veins, satin", paint="nature.blade", arguments=("leaf green", (0.35, 0.49, 0.13), (0.19, 0.34, 0.075), (0.53, 0.63, 0.28), (0.42, 0.36, 0.12), 0.12), tile_m=0.09, roughness=0.46, coat=0.12, sheen=0.2, relief_m=0.0004, apart=0.15),
    "leaf_autumn": Look("One autumn leaf, seen from near: orange and red with brown spots", paint="nature.blade", arguments=("leaf autumn", (0.86, 0.53, 0.10), (0.69, 0.22, 0.06), (0.50, 0.24, 0.07), (0.27, 0.13, 0.06), 0.45), tile_m=0.09, roughness=0.62, sheen=0.2, relief_m=0.0004, apart=0.25),
    "bark": Look("Bark of an oak: grey-brown ridges and deep cracks along the trunk", paint="nature.bark", arguments=("bark", (0.53, 0.46, 0.38), (0.36, 0.29, 0.225), (0.11, 0.085, 0.065), (0.33, 0.37, 0.19)), tile_m=0.32, grain=True, roughness=0.92, relief_m=0.006, vary=0.12, apart=0.15),
    "rock": Look("Weathered river rock", paint="nature.rock", arguments=("rock", (0.60, 0.58, 0.55), (0.27, 0.265, 0.26), (0.56, 0.58, 0.44)), tile_m=0.7, roughness=0.85, relief_m=0.014, vary=0.1, apart=0.2),
    "steel_brushed": Look("Brushed stainless steel", paint="fibre.brushed", arguments=("steel", bare("steel")), tile_m=0.35, grain=True, roughness=0.36, metallic=1.0, relief_m=0.00004),
    "steel_polished": _metal("Polished steel, as of a bearing's ball", "steel", 0.09),
    "steel_dark": Look("Blackened steel", paint="fibre.worn", arguments=("dark steel", (0.30, 0.30, 0.315), 1.5), tile_m=0.4, roughness=0.42, metallic=1.0, worn_m=0.004, beneath=bare("steel")),
    "aluminium": _metal("Bead-blasted aluminium", "aluminium", 0.42),
    "chrome": _metal("Mirror chrome", "chromium", 0.06),
    "brass": _metal("Polished brass", "brass", 0.20, HANDLED),
    "bronze": _metal("Polished bronze", "bronze", 0.24, HANDLED),
    "copper": _metal("Polished copper", "copper", 0.22, HANDLED),
    "gold": _metal("Polished gold", "gold", 0.16, HANDLED),
    "silver": _metal("Polished silver", "silver", 0.14),
    "titanium": _metal("Satin titanium", "titanium", 0.34),
    "iron_cast": Look("Grey cast iron, rough from the mould", paint="fibre.worn", arguments=("cast iron", bare("iron", CAST), 2.0), tile_m=0.2, roughness=0.62, metallic=1.0, relief_m=0.0006),
    "iron_rusty": Look("Rusty iron", paint="fibre.rust", arguments=("rust", (0.33, 0.30, 0.28), (0.50, 0.25, 0.12)), tile_m=0.6, roughness=0.85, metallic=0.25, relief_m=0.001, apart=0.1),
    "paint_red": _painted("Red paint on metal, chipped to the primer at its edges", (0.60, 0.075, 0.06), PRIMER),
    "paint_blue": _painted("Blue paint on metal, chipped to the primer at its edges", (0.07, 0.20, 0.47), PRIMER),
    "paint_green": _painted("Green paint on metal, chipped to the primer at its edges", (0.09, 0.30, 0.16), PRIMER),
    "paint_yellow": _painted("Yellow paint on metal, chipped to the primer at its edges", (0.88, 0.64, 0.07), PRIMER),
    "paint_grey": _painted("Grey paint on metal, chipped to bare steel at its edges", (0.33, 0.345, 0.36), (0.60, 0.59, 0.575)),
    "paint_wood_white": _painted("White paint on wood, rubbed to the wood at its edges", (0.87, 0.86, 0.82), BARE_PINE),
    "paint_wood_blue": _painted("Blue paint on wood, rubbed to the wood at its edges", (0.24, 0.41, 0.53), BARE_PINE),
    "paint_wood_green": _painted("Green paint on wood, rubbed to the wood at its edges", (0.33, 0.45, 0.34), BARE_PINE),
    "glass_clear": Look("Clear glass", rgba=(0.95, 0.98, 0.97, 0.25), roughness=0.03, clear=1.0, wall=True),
    "glass_green": Look("Green bottle glass, deeper the thicker it is", rgba=(0.60, 0.86, 0.67, 0.35), roughness=0.03, clear=1.0, index=1.52, absorbs=(105.0, 28.0, 90.0), wall=True),
    "glass_brown": Look("Brown bottle glass, deeper the thicker it is", rgba=(0.62, 0.36, 0.12, 0.45), roughness=0.03, clear=1.0, index=1.52, absorbs=(55.0, 150.0, 420.0), wall=True),
    "glass_blue": Look("Blue glass", rgba=(0.60, 0.76, 0.95, 0.35), roughness=0.03, clear=1.0, wall=True),
    "acrylic_clear": Look("Clear acrylic sheet", rgba=(0.96, 0.98, 0.99, 0.22), roughness=0.06, clear=1.0, wall=True),
    "plastic_red": _plastic("Red moulded plastic", (0.76, 0.075, 0.07)),
    "plastic_orange": _plastic("Orange moulded plastic", (0.92, 0.38, 0.06)),
    "plastic_yellow": _plastic("Yellow moulded plastic", (0.95, 0.74, 0.10)),
    "plastic_green": _plastic("Green moulded plastic", (0.10, 0.48, 0.20)),
    "plastic_blue": _plastic("Blue moulded plastic", (0.08, 0.27, 0.68)),
    "plastic_purple": _plastic("Purple moulded plastic", (0.36, 0.16, 0.56)),
    "plastic_white": _plastic("White moulded plastic", (0.90, 0.90, 0.885)),
    "plastic_grey": _plastic("Grey moulded plastic", (0.46, 0.47, 0.48)),
    "plastic_black": _plastic("Black moulded plastic", (0.055, 0.055, 0.06)),
    "leather_brown": Look("Brown leather", paint="fibre.leather", arguments=("leather", (0.42, 0.235, 0.135)), tile_m=0.13, roughness=0.48, coat=0.12, relief_m=0.0006, apart=0.08, worn_m=0.003),
    "leather_black": Look("Black leather", paint="fibre.leather", arguments=("leather black", (0.085, 0.08, 0.08)), tile_m=0.13, roughness=0.45, coat=0.12, relief_m=0.0006),
    "fabric_linen": Look("Natural linen", paint="fibre.weave", arguments=("linen", (0.83, 0.775, 0.67), (0.77, 0.71, 0.60), 40), tile_m=0.07, roughness=0.95, sheen=0.25, relief_m=0.0004),
    "fabric_blue": Look("Blue cotton", paint="fibre.weave", arguments=("cotton", (0.17, 0.28, 0.50), (0.22, 0.34, 0.57), 48, 0.6), tile_m=0.06, roughness=0.95, sheen=0.3, relief_m=0.0003),
    "fabric_red": Look("Red wool", paint="fibre.weave", arguments=("wool", (0.58, 0.10, 0.10), (0.50, 0.07, 0.08), 28, 1.4), tile_m=0.07, roughness=0.97, sheen=0.35, relief_m=0.0006),
    "carpet": Look("Short-pile beige carpet", paint="fibre.felt", arguments=("carpet", (0.62, 0.56, 0.48)), tile_m=0.35, roughness=0.97, sheen=0.35, relief_m=0.003, vary=0.10),
    "paper": Look("White paper", paint="fibre.paper", arguments=("paper", (0.94, 0.935, 0.91)), tile_m=0.2, roughness=0.9),
    "paper_kraft": Look("Brown kraft paper", paint="fibre.paper", arguments=("kraft", (0.68, 0.52, 0.35), 2.5), tile_m=0.2, roughness=0.88, apart=0.1),
    "cardboard": Look("Corrugated cardboard", paint="fibre.cardboard", arguments=("cardboard", (0.69, 0.52, 0.345)), tile_m=0.3, roughness=0.88, relief_m=0.0005, apart=0.1, worn_m=0.004),
    "cork": Look("Pressed cork", paint="stone.granite", arguments=("cork", (0.72, 0.53, 0.34), (0.60, 0.41, 0.25), (0.38, 0.23, 0.13)), tile_m=0.22, roughness=0.88, relief_m=0.0005, apart=0.08),
    "foam": Look("Soft grey foam", paint="fibre.worn", arguments=("foam", (0.36, 0.37, 0.40), 2.5), tile_m=0.1, roughness=0.98, relief_m=0.001),
    "water_clear": Look("Clear water in a vessel, seen through", rgba=(0.93, 0.97, 0.98, 0.25), roughness=0.03, clear=1.0, index=1.333, absorbs=(0.34, 0.057, 0.02)),
    "water_pond": Look("Water of a pond, seen through: green-brown where it is deep", rgba=(0.80, 0.88, 0.78, 0.4), roughness=0.03, clear=1.0, index=1.333, absorbs=(1.9, 0.95, 1.7)),
    "tea": Look("Black tea, clear: golden where it is thin, red-brown where it is deep", rgba=(0.86, 0.44, 0.12, 0.5), roughness=0.03, clear=1.0, index=1.334, absorbs=(5.0, 21.0, 55.0)),
    "wine_red": Look("Red wine: ruby where it is thin, nearly black where it is deep", rgba=(0.55, 0.06, 0.10, 0.6), roughness=0.03, clear=1.0, index=1.345, absorbs=(14.0, 95.0, 75.0)),
    "wine_white": Look("White wine, pale straw", rgba=(0.95, 0.90, 0.60, 0.35), roughness=0.03, clear=1.0, index=1.345, absorbs=(0.6, 1.8, 11.0)),
    "beer": Look("Pale beer, golden", rgba=(0.95, 0.68, 0.18, 0.45), roughness=0.03, clear=1.0, index=1.343, absorbs=(1.5, 8.0, 38.0)),
    "oil_olive": Look("Olive oil, golden green", rgba=(0.82, 0.74, 0.16, 0.45), roughness=0.03, clear=1.0, index=1.467, absorbs=(4.2, 5.2, 45.0)),
    "honey": Look("Clear honey, amber, darker the thicker it lies", rgba=(0.93, 0.58, 0.10, 0.5), roughness=0.05, coat=1.0, clear=0.8, index=1.49, absorbs=(4.5, 24.0, 130.0)),
    "wax": Look("Cream wax", rgba=(0.94, 0.89, 0.76, 1.0), roughness=0.42, coat=0.1, sheen=0.15),
    "apple_red": Look("Red apple with streaks and pale dots", paint="around.apple", arguments=((0.62, 0.035, 0.05), (0.80, 0.20, 0.09), (0.74, 0.68, 0.22)), around=True, roughness=0.26, coat=0.4, apart=0.08),
    "apple_green": Look("Green apple", paint="around.apple", arguments=((0.48, 0.62, 0.13), (0.62, 0.72, 0.25), (0.78, 0.80, 0.38)), around=True, roughness=0.26, coat=0.4, apart=0.08),
    "orange_peel": Look("Orange fruit with dimpled peel", paint="around.citrus", arguments=((0.95, 0.50, 0.06),), around=True, roughness=0.42, coat=0.2, relief_m=0.0008, apart=0.1),
    "lemon_peel": Look("Lemon with dimpled peel", paint="around.citrus", arguments=((0.95, 0.83, 0.16),), around=True, roughness=0.42, coat=0.2, relief_m=0.0008, apart=0.1),
    "lamp_warm": Look("Glowing warm lamp", rgba=(1.0, 0.80, 0.52, 1.0), roughness=0.6, emission=4.0),
    "screen_blue": Look("Lit display", rgba=(0.20, 0.42, 0.80, 1.0), roughness=0.2, emission=1.1),
}  # fmt: skip
