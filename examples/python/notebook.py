"""A mesh to its image, a picture of it, cloth over it, strain over the frames, a point cache: notebook.py [MESH] [FOLDER] [SIZE].

Cells are marked as notebooks and editors know them.
"""
# %% What is worked on
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")  # no window is wanted; leave this out in a notebook
import matplotlib.pyplot as plt
import numpy as np

import weft

words = dict(enumerate(sys.argv))
mesh = words.get(1, "builtin:knot")
folder = pathlib.Path(words.get(2, "."))
size = int(words.get(3, 129))

# %% The mesh as an image: any genus
V, F = weft.read_mesh(mesh)
image = weft.geometry_image(V, F, size=size, name=mesh)
image.save(folder / "image.exr")
print(f"{len(V)} vertices, genus {image.report['input']['genus']}; {image.quality['psnr_db']:.1f} dB")

# %% Positions as colours, and the surface made from them again
P = image.charts[0].positions
colours = (P - P.min((0, 1))) / np.ptp(P, (0, 1)).max()
V2, F2 = image.to_mesh()
figure = plt.figure(figsize=(9, 4))
figure.add_subplot(1, 2, 1).imshow(colours, origin="lower")
solid = figure.add_subplot(1, 2, 2, projection="3d")
solid.plot_trisurf(V2[:, 0], -V2[:, 2], V2[:, 1], triangles=F2[:, ::-1])
figure.savefig(folder / "image.png")

# %% A sheet falls onto it
low, high = V2.min(0), V2.max(0)
scale = 1 / (high - low).max()
centre = (low + high) / 2
simulation = weft.Simulation(frame_rate=60)
simulation.add_body(image, scale=scale, translate=-scale * np.array([centre[0], low[1], centre[2]]))
sheet = simulation.add_cloth(weft.builtin("sheet", size=size), fabric="cotton",
                             translate=(0, scale * (high - low)[1] + 0.02, 0))
strains = []
for frame in simulation.run(24):
    strains.append(frame.strain)
print(f"{simulation.particles} particles, {frame.contacts} contacts, {frame.intersections} intersections, "
      f"state {simulation.state_hash}")

# %% Strain over the frames
figure, axes = plt.subplots()
axes.plot([100 * strain.p99 for strain in strains], label="99 of 100 springs are below")
axes.plot([100 * strain.mean for strain in strains], label="mean")
axes.set(xlabel="frame", ylabel="strain [%]")
axes.legend()
figure.savefig(folder / "strain.png")

# %% A cache that Blender opens
weft.write_pc2(folder / "sheet.pc2", simulation.cache(sheet))
weft.write_mesh(folder / "sheet.obj", simulation.cache(sheet)[0], sheet.faces)
