"""Meshes that the recipes make: pairs of vertices and triangles, closed and seen from outside counter-clockwise."""

import itertools

import numpy as np


def turned(profile, n=48):
    """The closed surface of a profile of (radius, height) that begins and ends on the axis, turned about that."""
    (_, low), *profile, (_, high) = profile
    angles, last = 2 * np.pi * np.arange(n) / n, len(profile) - 1
    vertices = [(r * np.cos(angle), r * np.sin(angle), z) for r, z in profile for angle in angles]
    ends, at = (len(vertices), len(vertices) + 1), lambda k, i: k * n + i % n
    triangles = [(ends[0], at(0, i + 1), at(0, i)) for i in range(n)] + [(ends[1], at(last, i), at(last, i + 1)) for i in range(n)]
    for k, i in itertools.product(range(last), range(n)):
        triangles += [(at(k, i), at(k, i + 1), at(k + 1, i)), (at(k, i + 1), at(k + 1, i + 1), at(k + 1, i))]
    return [*vertices, (0, 0, low), (0, 0, high)], triangles


def cylinder(radius, length, n):
    """A cylinder about z around the origin, of n segments."""
    half = length / 2
    return turned([(0, -half), (radius, -half), (radius, half), (0, half)], n)


def box(*edges):
    """A box around the origin."""
    vertices = [tuple(sign * edge / 2 for sign, edge in zip(signs, edges)) for signs in itertools.product((-1, 1), repeat=3)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, [triangle for a, b, c, d in faces for triangle in [(a, b, c), (a, c, d)]]


def bottle(height=0.24, radius=0.04):
    """A bottle with a neck."""
    shoulder = [(radius * (0.65 + 0.35 * np.cos(a)), height * (0.75 - 0.1 * np.cos(a))) for a in np.linspace(0, np.pi, 12)]
    return turned([(0, 0), (radius, 0), *shoulder, (0.3 * radius, height), (0, height)])


def bowl(radius=0.09, wall=0.01):
    """A bowl, open above."""
    angles, inner = np.linspace(0.3, 1.5, 16), radius - wall
    outside = [(radius * np.sin(a), radius * (1 - np.cos(a))) for a in angles]
    inside = [(inner * np.sin(a), radius - inner * np.cos(a)) for a in reversed(angles)]
    return turned([(0, 0), *outside, *inside, (0, wall)])
