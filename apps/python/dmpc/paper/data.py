"""The printed figures of the article: D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and Control for Ray Tracing in Parallel", IEEE
CG&A 14(4), 1994, Tables 2 and 3."""

from dataclasses import dataclass

RESOLUTION = 512  # pixels a side of its pictures
NODES = (1, 2, 4, 8, 16, 32, 64)
# By the text about this many KB of the 4 MB of a node's memory are shared memory: its own pages and its cache.
SHARED_KILOBYTES = 3.2 * 1024
# The most bytes a second that messages of 1 KB allow between two nodes; and the cache of Rings4, in pages of 1 KB, at which the
# communication rate peaks, and the share of the former that is printed there.
NETWORK_RATE, PEAK_PAGES, PEAK_SHARE = 0.9e6, 204, 0.7


def efficiency(base_seconds, base_nodes, seconds, nodes):
    """Of `nodes` nodes in percent, against `base_nodes`."""
    return 100 * base_seconds * base_nodes / (seconds * nodes)


@dataclass(frozen=True)
class Scene:
    """A scene of the article, and ours in its place. Polygons to pages are those of Table 2, seconds by nodes those of Table 3."""

    title: str
    name: str
    remark: str
    polygons: int
    rays: int
    kilobytes: int
    pages_a_pixel: float
    seconds: dict

    @property
    def base(self):
        """The smallest machine with a time, the base of the efficiencies."""
        return min(self.seconds)

    def efficiency(self, nodes):
        return efficiency(self.seconds[self.base], self.base, self.seconds[nodes], nodes)

    def cache_share(self, nodes):
        """A node's cache as a share of the database: what its own pages leave of the shared memory, at most all others."""
        return min(max(SHARED_KILOBYTES / self.kilobytes - 1 / nodes, 0.0), 1 - 1 / nodes)


def _scene(title, name, remark, polygons, rays, kilobytes, pages, *seconds):
    return Scene(title, name, remark, polygons, rays, kilobytes, pages, dict(zip(NODES[-len(seconds):], seconds)))


SCENES = {scene.title: scene for scene in (
    _scene("Teapot", "teapot-8", "another teapot: theirs is not published", 3754, 1397473, 793, 58.19,
           11522, 5997, 3092, 1565, 786, 395, 200),
    _scene("Mountain", "mount-6-t6", "7 % fewer rays", 9920, 1722415, 2031, 61.94, 17103, 9038, 4626, 2350, 1185, 600, 307),
    _scene("Rings4", "rings-4-t1", "0.4 % more rays", 18002, 1872991, 4632, 125.91, 17926, 9204, 4655, 2336, 1181, 604),
    _scene("Tetra9", "tetra-9", "the same", 262144, 303239, 36189, 17.45, 295, 146, 78),
    _scene("Tetra10", "tetra-10", "the same", 1048576, 300962, 138851, 33.00, 226))}
CELLS = tuple((title, nodes) for title, scene in SCENES.items() for nodes in scene.seconds)  # the printed ones of Table 3
