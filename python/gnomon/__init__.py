# SPDX-License-Identifier: Apache-2.0
"""Real-time shadows, measured against ray-traced truth, with NumPy arrays in and out.

    import gnomon

    truth = gnomon.truth("contact", light="sun", size=(640, 360))
    for technique in ("shadow_map", "pcf:kernel=7", "ray_traced"):
        print(technique, gnomon.compare(technique, truth)["mae"])

Units are metres, +Y is up. Pictures are height x width arrays, row 0 on top. What cannot be done
raises gnomon.Error with a sentence. Arrays are never converted silently. Long calls run without
the interpreter's lock and end soon after Ctrl-C.
"""
from __future__ import annotations

import json
import os
import threading
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy

from . import _gnomon
from ._gnomon import Device, Error, Render, Scene, Truth, __version__

__all__ = [
    "Device", "Error", "Material", "Mesh", "Render", "Scene", "Truth", "camera", "compare",
    "devices", "error_map", "flip", "light", "load", "metrics", "qualities", "read_exr", "render",
    "scene", "scenes", "techniques", "truth",
]

for _type in (Device, Error, Render, Scene, Truth):
    _type.__module__ = __name__  # as tracebacks and help() say it

SceneLike = Union[Scene, str, "os.PathLike[str]"]
Lights = Union[str, Sequence[str], None]
Value = Union[bool, int, float, str]

_own = threading.local()


def _device(device: Device | None) -> Device:
    """The given device, or one that this thread keeps."""
    if device is not None:
        return device
    if not hasattr(_own, "device"):
        _own.device = Device()
    return _own.device


def _scene(of: SceneLike) -> Scene:
    return of if isinstance(of, Scene) else load(of)


def _lights(light: Lights) -> list[str]:
    lights = [] if light is None else list(light) if isinstance(light, (list, tuple)) else [light]
    for text in lights:
        if not isinstance(text, str):
            raise Error(f"a light is a text, as 'sun' or gnomon.light(...) gives, not {text!r}")
    return lights


def _whole(value: int, least: int, most: int, name: str) -> int:
    whole = hasattr(value, "__index__") and not isinstance(value, bool)
    if not whole or not least <= int(value) <= most:
        raise Error(f"{name} is {value!r}; it takes a whole number from {least} to {most}")
    return int(value)


def _size(size: tuple[int, int]) -> tuple[int, int]:
    try:
        width, height = size
    except (TypeError, ValueError):
        raise Error(f"size is {size!r}; it takes (width, height) in pixels") from None
    return _whole(width, 1, 16384, "width"), _whole(height, 1, 16384, "height")


def _params(params: Mapping[str, Value] | None) -> list[tuple[str, str]]:
    def text(name: str, value: Value) -> str:
        if isinstance(value, (bool, numpy.bool_)):
            return "true" if value else "false"
        if isinstance(value, str):
            return value
        if isinstance(value, (int, float, numpy.integer, numpy.floating)):
            return repr(value.item() if isinstance(value, numpy.generic) else value)
        raise Error(
            f"the parameter {name} is {value!r}; it takes a number, a truth value or a text")

    return [(name, text(name, value)) for name, value in (params or {}).items()]


@dataclass(frozen=True)
class Material:
    """How a surface looks, and whether light comes through it.

    color: linear red, green and blue, 0 to 1. alpha: below 1 the surface is semitransparent, and
    its shadow has its colour in techniques that write transmittance. metallic, roughness: as in
    glTF. emissive: radiance, linear. double_sided: seen from behind too; every surface casts
    shadows to both sides.
    """

    color: tuple[float, float, float] = (0.8, 0.8, 0.8)
    alpha: float = 1.0
    metallic: float = 0.0
    roughness: float = 0.9
    emissive: tuple[float, float, float] = (0.0, 0.0, 0.0)
    double_sided: bool = False
    name: str = ""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles of one material, placed once or many times.

    vertices: N x 3 float32, metres. triangles: M x 3 uint32, rows of `vertices`, counter-clockwise
    seen from outside. normals: N x 3 float32, or None for smooth ones. transforms: 4 x 4, or K x 4
    x 4 for K placements, each applied to columns (x, y, z, 1); None: as it is.
    """

    vertices: numpy.ndarray
    triangles: numpy.ndarray
    material: Material = Material()
    transforms: numpy.ndarray | None = None
    normals: numpy.ndarray | None = None
    name: str = ""


def load(
    name_or_file: str | os.PathLike[str],
    *,
    time: float = 0.0,
    detail: float = 1.0,
    gltf_scene: int = -1,
) -> Scene:
    """A built-in scene by name (scenes()), a .glb or .gltf file, or one of Gnomon's scene .json
    files.

    time: seconds into the file's animation. detail: times the triangles of a built-in scene.
    gltf_scene: which of a glTF file's scenes, -1 for its default.

    >>> gnomon.load("balls").triangle_count
    61442
    """
    return _gnomon.load(os.fspath(name_or_file), float(time), float(detail), gltf_scene)


def scene(meshes: Iterable[Mesh], *, name: str = "arrays") -> Scene:
    """A scene of arrays. It has no lights and cameras of its own: a sun and a camera that sees all
    of it are the defaults.

    >>> corners = numpy.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], numpy.float32)
    >>> square = numpy.array([[0, 1, 2], [0, 2, 3]], numpy.uint32)
    >>> lid = numpy.diag([0.3, 1, 0.3, 1]); lid[1, 3] = 0.5
    >>> floor = gnomon.Mesh(5 * corners, square)
    >>> gnomon.scene([floor, gnomon.Mesh(corners, square, transforms=lid)])
    <gnomon.Scene arrays, 4 triangles>
    """
    materials: dict[Material, int] = {}
    placed = []
    for mesh in meshes:
        if not isinstance(mesh, Mesh) or not isinstance(mesh.material, Material):
            raise Error(
                f"a scene is made of gnomon.Mesh with a gnomon.Material each, not of {mesh!r:.80}")
        values = vars(mesh.material).values()
        material = Material(*(tuple(v) if isinstance(v, (list, numpy.ndarray)) else v
                              for v in values))
        placed.append((mesh, materials.setdefault(material, len(materials))))
    return _gnomon.scene(name, list(materials), placed)


def _words(kind: str, values: Mapping[str, object]) -> str:
    def text(value: object) -> str:
        if isinstance(value, str):
            return value
        if isinstance(value, Iterable):
            return "/".join(text(v) for v in value)
        return repr(float(value))  # type: ignore[arg-type]

    words = [f"{name}={text(value)}" for name, value in values.items()]
    return ",".join([kind] * bool(kind) + words)


def light(kind: str, **values: float | str | Sequence[float]) -> str:
    """A light as the argument `light` takes it: a kind, or the name of one of the scene's, and
    what differs from it.

    kind: sun, spot, point, rect or disk. Degrees for elevation, azimuth, angle (apparent
    diameter), cone and inner; metres for position, target, radius, width and height; color as (r,
    g, b). What is left out is fitted to the scene.

    >>> gnomon.light("rect", position=(4, 7, 4), target=(0, 0, 0), width=2, height=1)
    'rect,position=4.0/7.0/4.0,target=0.0/0.0/0.0,width=2.0,height=1.0'
    """
    return _words(kind, values)


def camera(name: str = "", **values: float | Sequence[float]) -> str:
    """A camera as the argument `camera` takes it: the name of one of the scene's or "fit", and
    eye, target, up (x, y, z), fov (degrees), near (metres), ortho (half of the height in metres).

    >>> gnomon.camera(eye=(3, 2, 6), target=(0, 0.5, 0), fov=45)
    'eye=3.0/2.0/6.0,target=0.0/0.5/0.0,fov=45.0'
    """
    return _words(name, values)


def render(
    scene: SceneLike,
    technique: str = "shadow_map",
    *,
    light: Lights = None,
    camera: str = "",
    size: tuple[int, int] = (960, 540),
    params: Mapping[str, Value] | None = None,
    quality: str = "",
    samples: int = 1,
    repeats: int = 1,
    warm_up: int = 0,
    frame: int = 0,
    lit: bool = True,
    exposure: float = 0.0,
    ambient: float = 0.45,
    aovs: Iterable[str] = (),
    device: Device | None = None,
) -> Render:
    """Draws a scene with the shadows of one technique, as `gnomon render` does, to the bit.

    scene: from load() or scene(), or what load() takes. technique: its id (techniques()), perhaps
    with parameters after colons, or "@preset.json". light: a name, or what light() gives, or
    several; None: the scene's first that the technique takes. camera: a name, or what camera()
    gives; "": the scene's first. size: (width, height) in pixels. params: the technique's
    parameters by name. quality: "low", "medium", "high" or "exact", which choose technique and
    params for the light (qualities()). samples: pictures averaged in `lit`. repeats: timed frames,
    after one that is not where there are several. warm_up: frames before. frame: the only clock
    and seed. lit: shade too. exposure: stops brighter in `picture`. ambient: light from all
    around. aovs: further images, as "albedo"; depth and geometric_normal are always there. device:
    None: one that this thread keeps.

    >>> image = gnomon.render("contact", "pcf", light="sun", size=(640, 360), params={"kernel": 7})
    >>> image.visibility.shape, image.lit.shape
    ((360, 640), (360, 640, 3))
    """
    drawn = _scene(scene)
    settings = _settings(samples, repeats, warm_up, frame, lit, exposure, ambient, aovs)
    settings["quality"] = quality
    if quality and (params or technique != "shadow_map"):
        raise Error("a quality is a technique with its parameters; give either")
    return _device(device)._render(
        drawn, technique, _params(params), camera, _lights(light), _size(size), settings)


_AOVS = frozenset((
    "visibility", "depth", "normal", "geometric_normal", "albedo", "surface", "primitive",
    "position", "motion", "texel_footprint", "texel_footprint_perspective",
    "texel_footprint_projection",
))


def _settings(
    samples: int = 1,
    repeats: int = 1,
    warm_up: int = 0,
    frame: int = 0,
    lit: bool = False,
    exposure: float = 0.0,
    ambient: float = 0.45,
    aovs: Iterable[str] = (),
) -> dict[str, Any]:
    names = {aovs} if isinstance(aovs, str) else set(aovs)
    for name in names - _AOVS:
        raise Error(f"there is no further image {name!r}; there are {', '.join(sorted(_AOVS))}")
    return {
        "samples": _whole(samples, 1, 4096, "samples"),
        "repeats": _whole(repeats, 1, 10000, "repeats"),
        "warm_up": _whole(warm_up, 0, 10000, "warm_up"),
        "frame": _whole(frame, 0, 2**31 - 1, "frame"),
        "lit": bool(lit),
        "exposure": float(exposure),
        "ambient": float(ambient),
        "aovs": names,
        "quality": "",
    }


def truth(
    scene: SceneLike,
    *,
    light: str | None = None,
    camera: str = "",
    size: tuple[int, int] = (960, 540),
    samples: int = 256,
    transmittance: bool = False,
    cache: str | os.PathLike[str] = "",
) -> Truth:
    """Traces one light by the CPU: the mean over `samples` points of the light, its variance, and
    what each pixel shows.

    scene, light, camera, size: as render() takes them. transmittance: the colour that comes
    through semitransparent casters instead of visibility. cache: a folder; "": the user's, which
    `gnomon` shares.

    >>> lamp = gnomon.light("lamp", radius=0.3)
    >>> truth = gnomon.truth("balls", light=lamp, size=(320, 180), samples=64)
    >>> truth.mean.shape, truth.variance.dtype, truth.primitive.dtype
    ((180, 320), dtype('float32'), dtype('uint32'))
    """
    lights = _lights(light)
    if len(lights) > 1:
        raise Error(f"the truth is of one light, not of {len(lights)}; call truth() for each")
    count = _whole(samples, 1, 1 << 20, "samples")
    return _gnomon.truth(
        _scene(scene), camera, lights, _size(size), count, bool(transmittance), os.fspath(cache))


def _judge(
    image: numpy.ndarray | Render | str,
    truth: Truth,
    params: Mapping[str, Value] | None,
    mask: numpy.ndarray | None,
    reference: numpy.ndarray | Render | str | None,
    flip: bool,
    heat_map: bool,
    device: Device | None,
) -> tuple[dict[str, float], numpy.ndarray | None]:
    if isinstance(image, str):
        image = _device(device)._render_as(truth, image, _params(params), _settings(lit=flip))
    elif params:
        raise Error("params belong to a technique by name; a picture that is there has none")
    if isinstance(reference, str):
        reference = _device(device)._render_as(truth, reference, [], _settings())
    if not isinstance(image, Render):
        if isinstance(reference, Render):
            reference = reference.visibility
        if flip:
            raise Error("flip compares lit pictures; give a technique or what render() gave, "
                        "or call gnomon.flip(test, truth)")
        return _gnomon.compare_array(image, truth, mask, reference, heat_map)
    if mask is not None:
        raise Error("a picture by render() knows which pixels count; a mask goes with an array")
    if reference is not None and not isinstance(reference, Render):
        raise Error("the reference of a picture by render() is a technique or what render() gave")
    numbers, picture = _gnomon.compare_render(image, truth, reference, heat_map)
    if flip:
        numbers["flip"] = _device(device)._flip(image, truth)
    return numbers, picture


def compare(
    image: numpy.ndarray | Render | str,
    truth: Truth,
    *,
    params: Mapping[str, Value] | None = None,
    mask: numpy.ndarray | None = None,
    reference: numpy.ndarray | Render | str | None = None,
    flip: bool = False,
    device: Device | None = None,
) -> dict[str, float]:
    """Every metric that applies (metrics()), by name.

    image: a technique, which is drawn from the truth's camera under its light; or what render()
    gave; or an array of the truth's shape, float32, of your own making. params: of a technique.
    reference: another of the same; adds the filter metrics, the error of filtering alone. flip:
    adds the mean FLIP error of the lit picture. mask: H x W of bool, the pixels that count, of an
    array; None: all but the background. Of a technique and of render(), those count where raster
    and rays see the same surface, as in `gnomon compare`.

    >>> truth = gnomon.truth("contact", light="sun,angle=0", size=(320, 180))
    >>> gnomon.compare("ray_traced", truth)["wrong_outside_band"]
    0.0
    """
    return _judge(image, truth, params, mask, reference, flip, False, device)[0]


def error_map(
    image: numpy.ndarray | Render | str,
    truth: Truth,
    *,
    params: Mapping[str, Value] | None = None,
    mask: numpy.ndarray | None = None,
    device: Device | None = None,
) -> numpy.ndarray:
    """Where it errs, as a picture: blue is too dark, red too light, grey does not count; uint8,
    with a legend below."""
    picture = _judge(image, truth, params, mask, None, False, True, device)[1]
    assert picture is not None
    return picture


def flip(
    test: numpy.ndarray, truth: numpy.ndarray, *, pixels_per_degree: float = 67.0,
) -> tuple[float, numpy.ndarray]:
    """FLIP (Andersson et al. 2020) of two pictures, H x W x 3 float32, linear, for a screen (0 to
    1): the mean error and its map."""
    return _gnomon.flip(test, truth, float(pixels_per_degree))


def techniques(device: Device | None = None) -> list[dict[str, Any]]:
    """All techniques: id, title, output, lights, why it is unavailable on the device ("" where it
    is not), and parameters, each with name, default, range or choices, unit and help.

    >>> ray_traced = next(t for t in gnomon.techniques() if t["id"] == "ray_traced")
    >>> [parameter["name"] for parameter in ray_traced["parameters"]]
    ['samples']
    """
    return json.loads(_gnomon.techniques(device))


def scenes() -> list[dict[str, Any]]:
    """The built-in scenes: name, triangles, help, cameras and lights by name."""
    return json.loads(_gnomon.scenes())


def qualities() -> dict[str, Any]:
    """What each quality means for each kind of light, with its price: its time as a multiple of
    the baseline's, its memory and its errors, as measured (docs/quality.md)."""
    return json.loads(_gnomon.qualities())


def devices() -> list[dict[str, Any]]:
    """The Vulkan devices: name, driver, software, and what of the features that every device must
    have is missing ("": usable)."""
    return json.loads(_gnomon.devices())


def metrics() -> list[dict[str, Any]]:
    """What compare() measures: id, unit, help, and whether it is reported for hard and for soft
    lights."""
    return _gnomon.metrics()


def read_exr(file: str | os.PathLike[str]) -> numpy.ndarray:
    """The channels of an EXR file, H x W or H x W x C float32, as `gnomon render` writes them: R,
    G, B first, the rest by name."""
    return _gnomon.read_exr(os.fspath(file))
