#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""vtk_volume.py FOLDER SIZE FRAMES: VTK's GPU mapper on make_scene.py's scenes, resampled to SIZE^3.

Writes FOLDER/vtk.csv lines `view,table,size,wall_s,cpu_s` (minimum and median of FRAMES frames after the first) and the
pictures vtk_VIEW_TABLE_SIZE.rgb. Needs numpy, python3-vtk9 and a display (xvfb-run).
"""

import resource
import sys
import time
from pathlib import Path

import numpy as np
import vtk
from vtk.util import numpy_support

FANS, BEAMS, SAMPLES, SPACING_M = 20, 25, 1319, 0.38
WIDTH, HEIGHT = 1024, 768


def resampled(volume, size):
    """The volume on a cube of voxels round the sector, trilinear in dB, -90 outside; order z, y, x."""
    far = (SAMPLES - 1) * SPACING_M
    low, high = np.array([0, 0, -far * np.sin(np.pi / 4)]), np.array([far, far * np.sin(np.pi / 3), 0.0])
    x, y, z = (np.linspace(low[k], high[k], size, dtype=np.float32) for k in range(3))
    image = np.full((size, size, size), -90, np.float32)
    for k in range(size):
        yy, xx = np.meshgrid(y, x, indexing="ij")
        r = np.sqrt(xx * xx + yy * yy + z[k] * z[k])
        at = [np.degrees(np.arcsin(np.clip(-z[k] / np.maximum(r, 1e-6), -1, 1))) / 45 * (FANS - 1),
              np.degrees(np.arctan2(yy, xx)) / 60 * (BEAMS - 1), r / SPACING_M]
        inside = np.ones(r.shape, bool)
        for a, n in zip(at, volume.shape):
            inside &= (a >= 0) & (a <= n - 1)
        at = [np.clip(a, 0, n - 1.0001) for a, n in zip(at, volume.shape)]
        i = [a.astype(int) for a in at]
        f = [a - b for a, b in zip(at, i)]
        value = 0
        for corner in range(8):
            d = corner >> 2, corner >> 1 & 1, corner & 1
            weight = 1
            for g, bit in zip(f, d):
                weight = weight * (g if bit else 1 - g)
            value = value + weight * volume[i[0] + d[0], i[1] + d[1], i[2] + d[2]]
        image[k] = np.where(inside, value, -90)
    return image, low, (high - low) / (size - 1)


def volume_of(image, low, spacing, table):
    data = vtk.vtkImageData()
    data.SetDimensions(*image.shape[::-1])
    data.SetSpacing(*spacing)
    data.SetOrigin(*low)
    data.GetPointData().SetScalars(numpy_support.numpy_to_vtk(image.ravel(), deep=0))
    colour, opacity = vtk.vtkColorTransferFunction(), vtk.vtkPiecewiseFunction()
    for db, (r, g, b, extinction) in zip(np.linspace(-90, -20, 256), table):
        colour.AddRGBPoint(db, float(r), float(g), float(b))
        opacity.AddPoint(db, 1 - float(np.exp(-extinction)))
    look = vtk.vtkVolumeProperty()
    look.SetColor(colour)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(1.0)
    look.ShadeOff()
    look.SetInterpolationTypeToLinear()
    mapper = vtk.vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetInputData(data)
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetSampleDistance(SPACING_M)
    mapper.SetUseJittering(0)
    mapper.SetMaxMemoryInBytes(4 << 30)
    mapper.SetMaxMemoryFraction(1.0)
    out = vtk.vtkVolume()
    out.SetMapper(mapper)
    out.SetProperty(look)
    return out


def window_of(actor, view):
    rows = [[float(v) for v in line.split()] for line in view.read_text().splitlines()]
    renderer = vtk.vtkRenderer()
    renderer.AddVolume(actor)
    renderer.SetBackground(0, 0, 0)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(WIDTH, HEIGHT)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*rows[0])
    camera.SetFocalPoint(*rows[5])
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(rows[6][0])
    camera.SetClippingRange(0.5, 3000)
    return window, camera


def cpu_s():
    use = resource.getrusage(resource.RUSAGE_SELF)
    return use.ru_utime + use.ru_stime


def picture(window):
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    pixels = numpy_support.vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
    return np.ascontiguousarray(pixels.reshape(HEIGHT, WIDTH, -1)[::-1, :, :3])


def main():
    folder, size, frames = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    volume = np.fromfile(folder / "volume.f32", "<f4").reshape(FANS, BEAMS, SAMPLES)
    image, low, spacing = resampled(volume, size)
    with open(folder / "vtk.csv", "a") as csv:
        for view in ("overview", "closeup"):
            for name in ("schools", "haze"):
                table = np.fromfile(folder / f"{name}.tf", "<f4").reshape(256, 4)
                window, camera = window_of(volume_of(image, low, spacing, table), folder / f"{view}.view")
                window.Render()
                wall, cpu = [], []
                for _ in range(frames):
                    camera.Modified()
                    start, used = time.time(), cpu_s()
                    window.Render()
                    window.WaitForCompletion()
                    wall.append(time.time() - start)
                    cpu.append(cpu_s() - used)
                picture(window).tofile(folder / f"vtk_{view}_{name}_{size}.rgb")
                csv.write(f"{view},{name},{size},{min(wall):.4f},{sorted(cpu)[len(cpu) // 2]:.4f}\n")
                window.Finalize()


if __name__ == "__main__":
    main()
