"""The arithmetic behind predictions: the time of a ray by each family, from a machine's prices and a scene's counts.

Counts of pages, rays and questions a ray are those of "Measured by hand: pages or rays, by paths" in apps/lab/study/RESULTS.md, where 16
nodes render; what lies between its columns is interpolated in the logarithm of the cache's share of the database.
"""

import json
import math

from .. import program

# By scene: the least memory of questions and rays (MB), nodes read a ray, rays sent and questions asked a ray, and pages fetched a ray
# with caches of so many percent of the database.
SCENES = {
    "rings-4-t1": (0.475, 0.52, 14, 0.45, 1.84, ((0.2, 7.8), (1.6, 1.74), (5.7, 0.71), (94, 0.15))),
    "landscape-8": (1.03, 1.83, 9, 0.56, 1.13, ((0.2, 0.32), (1.2, 0.1), (94, 0.08))),
    "tetra-9": (0.90, 0.82, 6, 0.22, 0.44, ((0.2, 0.9), (1.6, 0.74), (94, 0.74))),
    "tetra-10": (2.78, 1.81, 6, 0.22, 0.44, ((0.2, 0.9), (1.6, 0.74), (94, 0.74))),
}
# Assumed: rays are repeated and unevenly spread (1.3 times the work, a balance of 60 % on 64 nodes), ends cost everyone a tenth, packets
# carry 4 rays or 2 questions, half of the questions ask once more for shading, other pixels hide nine tenths of a latency, and four samples
# of a pixel share half of their pages.
_UNEVEN, _REPEATED, _ENDS, _RAYS, _QUESTIONS, _ASK_AGAIN, _SEEN, _SHARED = 0.6, 1.3, 1.1, 4, 2, 1.5, 0.1, 0.5


def seconds_a_ray(machine, scene, megabytes, whole):
    """By family, in a node of so many megabytes, where copies need `whole`; without a family that has no room."""
    prices = json.loads(program.run(["machine", machine]))
    questions_least, rays_least, reads, sent, asked, misses = SCENES[scene]
    message, operations = prices["long_message"], {name: 1e-12 * ps for name, ps in prices["operation_ps"].items()}
    ends, latency = 1e-9 * (message["send_ns"] + message["receive_ns"]), 1e-9 * (message["latency_ns"] + 3 * prices["hop_ns"])
    computing = operations["ray_setup"] + reads * (operations["bvh_node_read"] + operations["triangle_test"]) + 0.5 * operations["shading"]
    faults = _SHARED * _between(misses, max(100 * megabytes / whole - 2, 0.2))
    fetch = 2 * ends + 1e-9 * prices["service_ns"] + _SEEN * (2 * latency + 1024e-12 * message["byte_ps"])
    times = {"pages": computing + reads * operations["cached_lookup"] + faults * fetch}
    if megabytes >= rays_least:
        times["rays"] = (_REPEATED * computing + sent * ((ends + _SEEN * latency) / _RAYS + operations["ray_packing"])) / _UNEVEN
    if megabytes >= questions_least:
        a_question = operations["question_setup"] + 2 * (ends + _SEEN * latency) / _QUESTIONS
        times["questions"] = computing + _ASK_AGAIN * asked * a_question
    if megabytes >= whole:
        times["copies"] = computing
    return {family: _ENDS * seconds for family, seconds in times.items()}


def _between(points, share):
    if share <= points[0][0]:
        return points[0][1]
    for (low, before), (high, after) in zip(points, points[1:]):
        if share <= high:
            part = math.log(share / low) / math.log(high / low)
            return before * (after / before) ** part
    return points[-1][1]


def expected(machine, memories):
    """The winner over scenes and its lead over the runner-up; `memories` has for each scene the megabytes of a node and of copies."""
    times = [seconds_a_ray(machine, scene, *memory) for scene, memory in memories.items()]
    families = set.intersection(*(set(each) for each in times))
    means = {family: math.exp(sum(math.log(each[family]) for each in times) / len(times)) for family in families}
    order = sorted(means, key=means.get)
    return order[0], means[order[1]] / means[order[0]] if len(order) > 1 else None
