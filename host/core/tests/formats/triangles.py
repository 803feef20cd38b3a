"""The triangles that trimesh finds in files: their names come on standard input, one a line.

Per file: the number of triangles as a 64-bit integer, then nine 64-bit floating-point numbers each. Little-endian.
"""

import sys

import numpy
import trimesh

for name in sys.stdin.read().splitlines():
    scene = trimesh.load_scene(name, process=False)
    found = [numpy.zeros((0, 3, 3))]
    for node in scene.graph.nodes_geometry:
        placing, geometry = scene.graph[node]
        mesh = scene.geometry[geometry]
        if not isinstance(mesh, trimesh.Trimesh):
            continue
        corners = numpy.asarray(mesh.vertices, dtype=numpy.float64)
        if not numpy.array_equal(placing, numpy.eye(4)):
            corners = trimesh.transform_points(corners, placing)
        found.append(corners[mesh.faces])
    triangles = numpy.concatenate(found)
    sys.stdout.buffer.write(len(triangles).to_bytes(8, "little") + triangles.astype("<f8").tobytes())
