#!/usr/bin/env python3
"""Values, densities and albedos of Mitsuba 3's BSDFs, as tables that the tests of src/materials read.

    make_bsdf_tables.py [OUTPUT]      default: bsdf/mitsuba.json beside this script

Needs the `mitsuba` package with the variants scalar_rgb and llvm_ad_rgb; takes about a minute. Directions
are given in the shading frame. `wo` is where the path comes from (Mitsuba's `si.wi`), `wi` where it goes
(Mitsuba's `wo`). Each case has:

    bsdf       what was asked, in Mitsuba's names; colours are linear RGB
    pairs      names of sets of direction pairs [wo, wi]
    value      eval() for radiance, one row per pair: f |cos|, one number if all channels are equal
    pdf        pdf() of the same pairs
    importance eval() for importance, where it differs
    lobes      for each of a few wo, the delta lobes as [wi, coefficient]
    albedo     for each of a few wo, the mean weight of samples (all lobes) and its standard error; not of
               blends, where Mitsuba 3.9.1 adds densities and probabilities (blends with delta lobes) or
               uses directions that were not made (blends with a side that scatters nothing)
    diffuse    eval_diffuse_reflectance() for the first of these wo
"""
import json
import math
import os
import sys

import mitsuba as mi
import numpy as np

SAMPLES = 1 << 20
ABOVE = [[0.0, 0.0, 1.0], [0.4, -0.3, 0.8], [-0.7, 0.5, 0.25]]


def unit(v):
    v = np.asarray(v, float)
    return v / np.linalg.norm(v)


def short(x):
    """A number with as many digits as single precision is worth."""
    x = float(x)
    return 0 if x == 0 else float(f"{x:.6g}")


def single(v):
    """Single-precision components, with just the digits that they need."""
    return [float(f"{np.float32(x):.9g}") for x in v]


def cosine(rng, side=1.0):
    z = math.sqrt(rng.uniform(0.0004, 1))
    phi = rng.uniform(0, 2 * math.pi)
    r = math.sqrt(1 - z * z)
    return np.array([r * math.cos(phi), r * math.sin(phi), side * z])


def reflect(w, m):
    return 2 * np.dot(w, m) * m - w


def refract(w, m, eta):
    """To the other side of an interface whose lower index over its upper one is eta."""
    c = np.dot(w, m)
    if c < 0:
        m, c, eta = -m, -c, 1 / eta
    s2 = (1 - c * c) / eta**2
    return None if s2 >= 1 else (c / eta - math.sqrt(1 - s2)) * m - w / eta


def make_pairs():
    rng = np.random.default_rng(7)
    sets = {}
    sets["above"] = [(cosine(rng), cosine(rng)) for _ in range(14)]
    grazing = [unit([1, 0.2, 0.01]), unit([-0.3, 1, 0.03]), unit([-1, 0.1, 0.02]), unit([0, 0, 1])]
    sets["above"] += [(grazing[0], grazing[2]), (grazing[1], grazing[0]), (grazing[3], grazing[1]),
                      (grazing[2], grazing[3])]
    sets["sides"] = [(cosine(rng), cosine(rng, -1)) for _ in range(8)]
    sets["sides"] += [(cosine(rng, -1), cosine(rng)) for _ in range(8)]
    sets["sides"] += [(cosine(rng, -1), cosine(rng, -1)) for _ in range(8)]
    for alpha in (0.01, 0.1, 0.3):
        sets[f"mirror {alpha}"] = near_mirror(rng, alpha, 10, 1)
        sets[f"mirror below {alpha}"] = near_mirror(rng, alpha, 5, -1)
        for eta in (1.5, 0.75, 2.4):
            sets[f"refraction {alpha} {eta}"] = near_refraction(rng, alpha, eta, 12)
    return {name: [[single(unit(a)), single(unit(b))] for a, b in pairs] for name, pairs in sets.items()}


def facet(rng, alpha):
    x, y = rng.normal(size=2) * alpha
    return unit([x, y, 1])


def near_mirror(rng, alpha, n, side):
    pairs = []
    while len(pairs) < n:
        o = cosine(rng, side)
        i = reflect(o, facet(rng, alpha))
        if i[2] * side > 0.01:
            pairs.append((o, i))
    return pairs


def near_refraction(rng, alpha, eta, n):
    pairs = []
    while len(pairs) < n:
        o = cosine(rng, 1 if len(pairs) % 2 else -1)
        i = refract(o, facet(rng, alpha), eta)
        if i is not None and i[2] * o[2] < -0.005:
            pairs.append((o, i))
    return pairs


def cases():
    """(name, bsdf, pair sets). A colour is a list of three, a nested BSDF a dictionary."""
    red, blue = [0.7, 0.2, 0.1], [0.1, 0.3, 0.6]
    gold = {"eta": [0.143, 0.375, 1.442], "k": [3.983, 2.386, 1.603]}

    def add(name, bsdf, *pairs):
        out.append((name, bsdf, list(pairs)))

    out = []
    add("diffuse", {"type": "diffuse", "reflectance": red}, "above", "sides")
    add("diffuse default", {"type": "diffuse"}, "above")
    add("null", {"type": "null"}, "above")
    add("conductor", {"type": "conductor"})
    add("conductor gold", {"type": "conductor", **gold, "specular_reflectance": [0.9, 0.8, 0.7]})
    add("conductor k 0", {"type": "conductor", "eta": [1.5, 1.0, 0.6], "k": [0.0, 0.0, 0.0]})

    for distribution in ("ggx", "beckmann"):
        for visible in (True, False):
            common = {"distribution": distribution, "sample_visible": visible}
            tag = f"{distribution}{'' if visible else ' all normals'}"
            for alpha in (0.01, 0.1, 0.3, 0.8):
                near = f"mirror {min(alpha, 0.3)}"
                add(f"roughconductor {tag} {alpha}",
                    {"type": "roughconductor", **common, **gold, "alpha": alpha}, "above", near)
            add(f"roughconductor {tag} anisotropic",
                {"type": "roughconductor", **common, "alpha_u": 0.05, "alpha_v": 0.4,
                 "specular_reflectance": red}, "above", "sides", "mirror 0.1", "mirror 0.3")
            for alpha in (0.1, 0.3):
                for ior in ((1.5, 1.0), (1.0, 1 / 0.75), (2.4, 1.0)):
                    eta = round(ior[0] / ior[1], 4)
                    add(f"roughdielectric {tag} {alpha} {eta}",
                        {"type": "roughdielectric", **common, "alpha": alpha, "int_ior": ior[0],
                         "ext_ior": ior[1]},
                        "sides", f"mirror {alpha}", f"mirror below {alpha}",
                        f"refraction {alpha} {eta}")
            add(f"roughplastic {tag}",
                {"type": "roughplastic", **common, "alpha": 0.1, "diffuse_reflectance": red},
                "above", "mirror 0.1")
        add(f"roughdielectric {distribution} fine",
            {"type": "roughdielectric", "distribution": distribution, "alpha": 0.01, "int_ior": 1.5,
             "ext_ior": 1.0}, "mirror 0.01", "refraction 0.01 1.5")
        add(f"roughdielectric {distribution} coloured anisotropic",
            {"type": "roughdielectric", "distribution": distribution, "alpha_u": 0.1, "alpha_v": 0.3,
             "int_ior": 1.5, "ext_ior": 1.0, "specular_reflectance": [0.9, 0.8, 0.7],
             "specular_transmittance": blue}, "sides", "mirror 0.1", "refraction 0.3 1.5")
        for alpha in (0.02, 0.3, 0.7, 1.2):
            add(f"roughplastic {distribution} {alpha} nonlinear",
                {"type": "roughplastic", "distribution": distribution, "alpha": alpha,
                 "nonlinear": True, "diffuse_reflectance": red, "specular_reflectance": blue},
                "above", "sides", "mirror 0.3")
        for eta in (1.1, 2.4):
            add(f"roughplastic {distribution} eta {eta}",
                {"type": "roughplastic", "distribution": distribution, "alpha": 0.2, "int_ior": eta,
                 "ext_ior": 1.0, "diffuse_reflectance": red}, "above", "mirror 0.1")

    for name, ior in (("", {}), ("air in water", {"int_ior": 1.0, "ext_ior": 1.333}),
                      ("matched", {"int_ior": 1.2, "ext_ior": 1.2})):
        for kind in ("dielectric", "thindielectric"):
            add(f"{kind} {name}".strip(), {"type": kind, **ior})
    for kind in ("dielectric", "thindielectric"):
        add(f"{kind} coloured", {"type": kind, "int_ior": 1.5, "ext_ior": 1.0,
                                 "specular_reflectance": [0.9, 0.8, 0.7],
                                 "specular_transmittance": blue})
    add("plastic", {"type": "plastic"}, "above", "sides")
    add("plastic nonlinear", {"type": "plastic", "nonlinear": True, "diffuse_reflectance": red,
                              "specular_reflectance": blue, "int_ior": 1.9, "ext_ior": 1.0}, "above")
    add("plastic eta 1.1", {"type": "plastic", "diffuse_reflectance": red, "int_ior": 1.1,
                            "ext_ior": 1.0}, "above")

    base = {"type": "principled", "base_color": red}
    add("principled default", {"type": "principled"}, "above", "sides", "mirror 0.3")
    for name, more in (("rough 0.1", {"roughness": 0.1}), ("rough 1", {"roughness": 1.0}),
                       ("anisotropic", {"roughness": 0.4, "anisotropic": 0.8}),
                       ("metallic", {"metallic": 1.0, "roughness": 0.3}),
                       ("half metallic", {"metallic": 0.4, "roughness": 0.3, "spec_tint": 0.3}),
                       ("specular 0.8", {"specular": 0.8}), ("specular 0", {"specular": 0.0}),
                       ("eta 0.8", {"eta": 0.8, "metallic": 0.3, "spec_tint": 0.5, "clearcoat": 0.7}),
                       ("spec_tint", {"spec_tint": 0.7}), ("sheen", {"sheen": 0.8}),
                       ("sheen tint", {"sheen": 0.5, "sheen_tint": 0.6}),
                       ("flatness", {"flatness": 0.6}),
                       ("clearcoat", {"clearcoat": 1.0, "clearcoat_gloss": 0.3}),
                       ("clearcoat glossy", {"clearcoat": 0.6, "clearcoat_gloss": 1.0}),
                       ("black", {"base_color": [0.0, 0.0, 0.0], "spec_tint": 0.5, "sheen": 0.4,
                                  "sheen_tint": 0.5}),
                       ("rates", {"clearcoat": 1.0, "diffuse_reflectance_sampling_rate": 0.5,
                                  "main_specular_sampling_rate": 2.0,
                                  "clearcoat_sampling_rate": 3.0})):
        add(f"principled {name}", {**base, **more}, "above", "mirror 0.1", "mirror 0.3")
    for name, more in (("glass", {"spec_trans": 1.0, "eta": 1.5, "roughness": 0.5}),
                       ("half glass", {"spec_trans": 0.5, "eta": 1.5, "roughness": 0.4,
                                       "metallic": 0.2, "clearcoat": 0.5, "sheen": 0.3}),
                       ("thin glass", {"spec_trans": 0.9, "eta": 0.75, "roughness": 0.5}),
                       ("glass specular 0", {"spec_trans": 0.7, "specular": 0.0})):
        eta = 0.75 if name == "thin glass" else 1.5
        add(f"principled {name}", {**base, **more}, "above", "sides", "mirror 0.3",
            "mirror below 0.3", f"refraction 0.3 {eta}")
    thin = {"type": "principledthin", "base_color": red}
    add("principledthin default", {"type": "principledthin"}, "above", "sides")
    for name, more in (("spec_trans", {"spec_trans": 0.6, "roughness": 0.4, "eta": 1.4}),
                       ("diff_trans", {"diff_trans": 0.8}),
                       ("all", {"spec_trans": 0.3, "diff_trans": 1.2, "spec_tint": 0.6, "sheen": 0.5,
                                "sheen_tint": 0.5, "flatness": 0.4, "anisotropic": 0.7,
                                "roughness": 0.6, "eta": 1.7}),
                       ("rates", {"spec_trans": 0.5, "diff_trans": 1.0,
                                  "specular_reflectance_sampling_rate": 0.5,
                                  "specular_transmittance_sampling_rate": 2.0,
                                  "diffuse_reflectance_sampling_rate": 3.0,
                                  "diffuse_transmittance_sampling_rate": 0.25}),
                       ("sheen", {"sheen": 1.0}), ("eta below 1", {"spec_trans": 1.0, "eta": 0.8})):
        add(f"principledthin {name}", {**thin, **more}, "above", "sides", "mirror 0.3")

    metal = {"type": "roughconductor", "distribution": "ggx", "alpha_u": 0.3, "alpha_v": 0.1}
    paint = {"type": "roughplastic", "distribution": "ggx", "alpha": 0.2, "diffuse_reflectance": blue}
    glass = {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.3, "int_ior": 1.5,
             "ext_ior": 1.0}
    mirror = {"type": "conductor", "specular_reflectance": red}
    matt = {"type": "diffuse", "reflectance": red}
    add("twosided", {"type": "twosided", "nested": [matt]}, "above", "sides")
    add("twosided different", {"type": "twosided", "nested": [metal, paint]}, "above", "sides",
        "mirror below 0.3")
    add("twosided mirror", {"type": "twosided", "nested": [mirror]})
    for opacity in (0.0, 0.3, 1.0, 1.7):
        add(f"mask {opacity}", {"type": "mask", "opacity": opacity, "nested": [paint]}, "above")
    add("mask of mirror", {"type": "mask", "opacity": 0.6, "nested": [mirror]})
    for weight in (0.0, 0.35, 1.0, -0.5):
        add(f"blend {weight}", {"type": "blendbsdf", "weight": weight, "nested": [matt, metal]},
            "above", "mirror 0.3")
    add("blend with deltas", {"type": "blendbsdf", "weight": 0.25, "nested": [
        mirror, {"type": "plastic", "diffuse_reflectance": blue}]}, "above")
    add("blend of blends", {"type": "blendbsdf", "weight": 0.3, "nested": [
        {"type": "twosided", "nested": [paint]},
        {"type": "blendbsdf", "weight": 0.6, "nested": [glass, matt]}]}, "above", "sides",
        "refraction 0.3 1.5")
    for name, flip, shadow in (("", True, True), (" unflipped", False, True),
                               (" unshadowed", True, False), (" plain", False, False)):
        options = {"flip_invalid_normals": flip, "use_shadowing_function": shadow}
        for normal in ([0.3, 0.1, 0.9], [-0.7, 0.5, 0.4]):
            strength = "" if normal[2] > 0.5 else " strong"
            for inner_name, inner in (("metal", metal), ("paint", paint)):
                add(f"normalmap{strength}{name} on {inner_name}",
                    {"type": "normalmap", "normal": normal, **options, "nested": [inner]},
                    "above", "mirror 0.3")
        add(f"bumpmap{name}", {"type": "bumpmap", "slope": [0.7, -0.4], "scale": 1.5, **options,
                               "nested": [metal]}, "above", "mirror 0.3")
    add("normalmap on glass", {"type": "normalmap", "normal": [0.5, -0.3, 0.8], "nested": [glass]},
        "above", "sides", "refraction 0.3 1.5")
    add("normalmap pointing down", {"type": "normalmap", "normal": [0.5, -0.3, -0.4],
                                    "nested": [matt]}, "above", "sides")
    add("normalmap on mirror", {"type": "normalmap", "normal": [0.3, 0.1, 0.9], "nested": [mirror]})
    add("normalmap on mask", {"type": "normalmap", "normal": [0.3, 0.1, 0.9], "nested": [
        {"type": "mask", "opacity": 0.4, "nested": [matt]}]}, "above")
    add("twosided of normalmap", {"type": "twosided", "nested": [
        {"type": "normalmap", "normal": [-0.7, 0.5, 0.4], "nested": [paint]}]}, "above", "sides")
    add("normalmap of twosided", {"type": "normalmap", "normal": [-0.7, 0.5, 0.4], "nested": [
        {"type": "twosided", "nested": [metal, matt]}]}, "above", "sides")
    add("twosided of bumpmap", {"type": "twosided", "nested": [
        {"type": "bumpmap", "slope": [0.7, -0.4], "nested": [metal]}]}, "above", "sides",
        "mirror below 0.3")
    # Maps within maps: of the outer one's frame Mitsuba 3.9.1 keeps the axes apart from those of the world, which
    # makes no difference here.
    bumps, normals = {"type": "bumpmap", "slope": [0.5, -0.3]}, {"type": "normalmap", "normal": [-0.4, 0.3, 0.8]}
    for outer, inner in ((bumps, normals), (normals, bumps), (bumps, {**bumps, "scale": -0.5}), (normals, normals)):
        add(f"{outer['type']} of {inner['type']}", {**outer, "nested": [{**inner, "nested": [metal]}]}, "above",
            "mirror 0.3")
    add("twosided of bumpmap of blend with normalmap", {"type": "twosided", "nested": [{**bumps, "nested": [
        {"type": "blendbsdf", "weight": 0.4, "nested": [matt, {**normals, "nested": [metal]}]}]}]}, "above", "sides",
        "mirror below 0.3")
    add("bumpmap of twosided of bumpmap", {**bumps, "nested": [{"type": "twosided", "nested": [
        {**bumps, "flip_invalid_normals": False, "nested": [metal]}]}]}, "above", "sides", "mirror below 0.3")

    for name, more in (("", {}), (" smooth", {"longitudinal_roughness": 0.1, "azimuthal_roughness": 0.15}),
                       (" rough", {"longitudinal_roughness": 0.9, "azimuthal_roughness": 0.8}),
                       (" fair", {"eumelanin": 0.2, "pheomelanin": 0.4, "scale_tilt": 5.0}),
                       (" dyed", {"sigma_a": [0.2, 0.25, 0.7], "scale": 3.0, "int_ior": 1.4, "ext_ior": 1.0})):
        add(f"hair{name}", {"type": "hair", **more}, "above", "sides")
    for distribution in ("beckmann", "ggx"):
        add(f"pplastic {distribution}",
            {"type": "pplastic", "distribution": distribution, "alpha": 0.2, "diffuse_reflectance": red},
            "above", "sides", "mirror 0.1")
    add("pplastic anisotropic",
        {"type": "pplastic", "distribution": "ggx", "alpha_u": 0.3, "alpha_v": 0.1, "int_ior": 1.9, "ext_ior": 1.0,
         "diffuse_reflectance": blue, "specular_reflectance": 0.6}, "above", "mirror 0.3")
    for kind in ("polarizer", "retarder", "circular"):
        add(kind, {"type": kind, "transmittance": [0.9, 0.5, 0.2]})
    return out


# The surface: tangents that are neither orthogonal nor of unit length, so that bump maps see both.
TANGENT_U, TANGENT_V = [1.3, 0.0, 0.0], [0.4, 0.9, 0.0]


def to_dict(bsdf):
    out = {}
    for key, value in bsdf.items():
        if key == "nested":
            for k, nested in enumerate(value):
                out[f"nested_{k}"] = to_dict(nested)
        elif key == "normal":
            out["normalmap"] = constant_image((unit(value) + 1) / 2)
        elif key == "slope":
            out["height"] = ramp(value)
        elif isinstance(value, list):
            out[key] = colour(value, key)
        else:
            out[key] = value
    return out


def colour(value, key):
    """Optical constants are not clamped to [0, 1] as reflectances are."""
    if key in ("eta", "k", "sigma_a"):
        return {"type": "srgb", "color": mi.ScalarColor3f(value), "unbounded": True}
    return {"type": "rgb", "value": value}


def image(data, **more):
    bitmap = mi.Bitmap(np.ascontiguousarray(data, np.float32))
    return {"type": "bitmap", "bitmap": bitmap, "raw": True, **more}


def constant_image(rgb):
    return image(np.broadcast_to(rgb, (2, 2, 3)))


def ramp(slope):
    """A 3×3 height field whose gradient at the middle is `slope`."""
    x = (np.arange(3) + 0.5) / 3
    data = slope[0] * x[None, :] + slope[1] * x[:, None]
    return image(data[..., None], wrap_mode="clamp")


def interaction(wo):
    si = mi.SurfaceInteraction3f()
    si.t = 1
    si.p = [0, 0, 0]
    si.n = [0, 0, 1]
    si.sh_frame = mi.Frame3f([1, 0, 0], [0, 1, 0], [0, 0, 1])
    si.dp_du, si.dp_dv = TANGENT_U, TANGENT_V
    si.uv = [0.5, 0.5]
    si.wi = wo
    return si


def row(c):
    c = [short(x) for x in c]
    return c[0] if c[0] == c[1] == c[2] else c


def evaluate(case, sets):
    name, description, names = case
    bsdf = mi.load_dict(to_dict(description))
    radiance, importance = mi.BSDFContext(), mi.BSDFContext(mi.TransportMode.Importance)
    out = {"name": name, "bsdf": description, "pairs": names}
    pairs = [p for n in names for p in sets[n]]
    value = [row(bsdf.eval(radiance, interaction(o), i)) for o, i in pairs]
    other = [row(bsdf.eval(importance, interaction(o), i)) for o, i in pairs]
    if any(v != 0 for v in value):
        out["value"] = value
        out["pdf"] = [short(bsdf.pdf(radiance, interaction(o), i)) for o, i in pairs]
    if other != value:
        out["importance"] = other
    lobes = []
    for wo in views(bsdf):
        found = []
        if description["type"] == "hair":  # it says that it has a null lobe, but has none
            continue
        for k in range(bsdf.component_count()):
            if not bsdf.flags(k) & mi.BSDFFlags.Delta.value and not bsdf.flags(
                    k) & mi.BSDFFlags.Null.value:
                continue
            context = mi.BSDFContext()
            context.component = k
            sample, weight = bsdf.sample(context, interaction(wo), 0.3, [0.4, 0.6])
            if max(weight) > 0:
                found.append([[short(x) for x in sample.wo], row(weight)])
        lobes.append(found)
    # Mixtures do not weigh their components when asked for one of them alone.
    if any(lobes) and "nested" not in description:
        out["lobes"] = lobes
    out["views"] = views(bsdf)
    out["diffuse"] = row(bsdf.eval_diffuse_reflectance(interaction(out["views"][0])))
    return out


def views(bsdf):
    above = [single(unit(w)) for w in ABOVE]
    both = bsdf.flags() & mi.BSDFFlags.BackSide.value
    return above + ([[w[0], w[1], -w[2]] for w in above[1:]] if both else [])


def add_albedo(case, out):
    import drjit as dr
    if case[1]["type"] == "blendbsdf":
        return
    bsdf = mi.load_dict(to_dict(case[1]))
    sampler = mi.load_dict({"type": "independent"})
    rows = []
    for wo in out["views"]:
        sampler.seed(len(rows), SAMPLES)
        si = dr.zeros(mi.SurfaceInteraction3f, SAMPLES)
        scalar = interaction(wo)
        for field in ("t", "p", "n", "dp_du", "dp_dv", "uv", "wi", "sh_frame"):
            setattr(si, field, getattr(scalar, field))
        sample, weight = bsdf.sample(mi.BSDFContext(), si, sampler.next_1d(), sampler.next_2d())
        w = np.asarray(weight, dtype=np.float64).reshape(3, -1) * np.ones((3, SAMPLES))
        w[~np.isfinite(w)] = 0
        rows.append([row(w.mean(axis=1)), short(w.std(axis=1).max() / math.sqrt(SAMPLES))])
    out["albedo"] = rows


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "bsdf", "mitsuba.json")
    mi.set_variant("scalar_rgb")
    sets = make_pairs()
    every = cases()
    tables = [evaluate(case, sets) for case in every]
    mi.set_variant("llvm_ad_rgb")
    for case, table in zip(every, tables):
        add_albedo(case, table)
    used = {n for t in tables for n in t["pairs"]}
    document = {"mitsuba": mi.__version__, "dp_du": TANGENT_U, "dp_dv": TANGENT_V,
                "pairs": {n: p for n, p in sets.items() if n in used}}
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    compact = lambda x: json.dumps(x, separators=(",", ":"))
    with open(path, "w") as f:
        f.write(compact(document)[:-1] + ',"cases":[\n' + ",\n".join(map(compact, tables)) + "\n]}\n")
    print(f"{len(tables)} cases, {os.path.getsize(path)} bytes")


if __name__ == "__main__":
    main()
