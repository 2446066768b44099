"""The claims of the article's text, each compared with our runs."""

from ..studies.judging import is_tie
from ..studies.table import Column, Table
from ..studies.texts import counted
from .catalogue import ARTICLE_ITEM, CACHE_NODES, CACHES, ITEM_SIDES, LOADED_NODES, RINGS
from .data import NODES, PEAK_PAGES, PEAK_SHARE, RESOLUTION, SCENES, efficiency
from .tables import against_one, cells_of, item_text, network_share

HELD, NOT_HELD, TIE, NOT_JUDGED = "held", "not held", "a tie", "not judged"
_SHOWN = 0.05  # half of the last digit that efficiencies are shown with


def claims(found, resolution):
    """A row for each claim: the verdict, what was found, and why if it is not held, as far as that is known. Prices are fitted to the
    article's resolution, so pictures of another one judge nothing."""
    table = Table("What the text claims", [Column(name) for name in ("claim", "verdict", "found", "why")])
    for judge in (_efficiency, _fall, _misfit, _caches, _faster, _loads, _overflow, _light, _tests, _items, _scheduling, _copies, _extents):
        for claim, verdict, text, why in judge(found):
            verdict = verdict if isinstance(verdict, str) else HELD if verdict else NOT_HELD
            table.add([claim, verdict if resolution == RESOLUTION else NOT_JUDGED, text, "" if verdict == HELD else why])
    return table


def _efficiency(found):
    least = min(min(cell.efficiency, cell.efficiency_by_worker) for cell in cells_of(found, "article"))
    yield "With up to 64 nodes the efficiency is almost always above 78 %", least > 78, f"the least is {least:.1f} %", ""


def _fall(found):
    """Each number of nodes must be below the one before; it is a tie if two are the same to the digits shown, and none rises."""
    for scene in RINGS:
        rays = [against_one(found, scene, found["rays", scene, nodes]) for nodes in NODES]
        pages = against_one(found, scene, found["pages", scene, 64])
        least = min(before - after for before, after in zip(rays, rays[1:]))
        verdict = NOT_HELD if rays[-1] >= pages or least < -_SHOWN else HELD if least > _SHOWN else TIE
        yield (f"The efficiency of travelling rays falls with the nodes, and is below travelling pages', {scene}", verdict,
               f"{', '.join(f'{each:.1f}' for each in rays)} % on 1 to 64 nodes; pages {pages:.1f} % on 64",
               "two numbers of nodes differ by less than the cuts that the subsampled picture happens to make")


def _misfit(found):
    yield ("On 2 and 4 nodes Rings4 does not fit into 4 MB by travelling rays", NOT_HELD, "it fits",
           "open: half of the scene's 4.6 MB and the queues fit into 4 MB")


def _cache_for_half(found, title):
    """Of the smallest cache from which on all have more than 50 %: words, and its share of the article's database, which no cache has if
    there is none."""
    base = found["cached", title, None]
    enough = None
    for size in reversed(CACHES[title]):
        if efficiency(base.seconds, 1, found["cached", title, size].seconds, CACHE_NODES) <= 50:
            break
        enough = size
    if enough is None:
        return f"{title} with none", float("inf")
    share = enough / SCENES[title].kilobytes
    return f"{title} from {enough} pages on, {100 * share:.2f} % of the database", share


def _caches(found):
    (rings, rings_share), (tetra, tetra_share) = (_cache_for_half(found, title) for title in CACHES)
    yield ("Rings4 needs larger caches than Tetra9 to stay above 50 %, as a share of the database", rings_share > tetra_share,
           f"{rings}; {tetra}", "")
    sizes = CACHES["Rings4"]
    traffic = {size: network_share(found["cached", "Rings4", size]) for size in sizes}
    peak = max(sizes, key=traffic.get)
    yield ("The communication rate of Rings4 peaks (theirs at 204 pages) and falls for smaller caches", sizes[0] < peak < sizes[-1],
           f"the most travels with {counted(peak, 'page')}",
           "open: a node waits for each page, so it asks no faster than pages come, and nothing modelled slows them")
    shown = ", ".join(f"{counted(size, 'page')} {100 * traffic[size]:.0f} %" for size in reversed(sizes) if size <= PEAK_PAGES)
    yield ("At the peak the network carries about 70 % of the 0.9 MB/s that messages of 1 KB allow",
           PEAK_SHARE - 0.1 < traffic[PEAK_PAGES] < PEAK_SHARE + 0.1, f"both ways with {shown}",
           "the level is reached by smaller caches; what slows theirs with 204 pages is open")


def _faster(found):
    ratio = found["article", "Rings4", CACHE_NODES].seconds / found["faster"].seconds
    yield ("The iPSC/860 is about 7 times faster (Rings4, 32 nodes)", 6 < ratio < 8,
           f"{ratio:.2f} times; its processor is modelled as 7 times faster, so this tests the network alone", "")


def _loads(found):
    """Judged at one of the numbers of nodes, as the article does not say which."""
    loads = [(100 * found["rays", RINGS[0], nodes].average_load, 100 * found["equal sizes", nodes].average_load) for nodes in LOADED_NODES]
    subsampled, equal = (", ".join(f"{load:.1f}" for load in each) for each in zip(*loads))
    yield ("Subsampled regions load nodes to about 82.5 % (Rings3), regions of equal size to less than 20 %",
           any(77.5 < load < 87.5 and of_equal < 20 for load, of_equal in loads),
           f"{subsampled} % and {equal} % on 16, 32 and 64 nodes; the article does not say on how many",
           "a plain grid spreads a ray's work along its way, so regions are loaded more evenly than theirs")


def _overflow(found):
    usual, long = ({scene: found["way", scene, way].overflowed for scene in RINGS} for way in ("as in 1994", "long queue"))
    yield ("About 0.5 % of the messages of some pictures go by way of the host",
           any(0.0025 < share < 0.01 for share in (*usual.values(), *long.values())),
           f"{', '.join(f'{scene} {100 * share:.2f} %' for scene, share in long.items())} by queues that fill the memories, otherwise "
           f"{' and '.join(f'{100 * share:.2f}' for share in usual.values())} %, on 64 nodes",
           "the length of their queues and the rays of a message are not printed")


def _light(found):
    """Twice the mean counts as a flood, a quarter above it does not."""
    rays, pages = found["lit", "rays"].flood, found["lit", "pages"].flood
    yield ("A light inside floods its region with shadow rays; where pages travel it is cached (Rings4)", rays > 2 and pages < 1.25,
           f"its region gets {rays:.1f} times the mean of shadow rays; no node sends over {pages:.2f} times the mean of pages; 64 nodes",
           "")


def _tests(found):
    ratio = found["rays", RINGS[1], 64].tests / found["rays", RINGS[1], 1].tests
    yield ("An object in several regions is intersected again in each (Rings4)", ratio > 1,
           f"{ratio:.2f} times the tests on 64 nodes as on one", "")


def _items(found):
    seconds = {side: found["item", side].seconds for side in ITEM_SIDES}
    yield ("Work items of about 3x3 pixels are the good compromise (Rings4, 64 nodes)",
           is_tie(seconds[ARTICLE_ITEM], min(seconds.values())),
           "seconds: " + ", ".join(f"{item_text(side)} {each:.0f}" for side, each in seconds.items()), "")


def _scheduling(found):
    """Static and on-demand assignment are compared with the article's method, which is both."""
    both, submaps, items, pixels = (found[key].seconds for key in (
        ("item", ARTICLE_ITEM), ("item", 0), ("asked of the host", ARTICLE_ITEM), ("asked of the host", 1)))
    best = min(submaps, items, pixels)
    yield ("Submaps and then items on request do better than either alone (Rings4, 64 nodes)", TIE if is_tie(both, best) else both < best,
           f"seconds: both {both:.0f}, submaps {submaps:.0f}, items asked of the host {items:.0f}, pixels {pixels:.0f}",
           "the host answers at once here, and takes no time of a node's; submaps have fewer faults")


def _copies(found):
    """What pages cost a small scene is the look-up of cached pages, whose price is fitted to the article's own cells: it proves nothing."""
    ratio = found["article", "Teapot", 64].seconds / found["copies"].seconds
    yield ("A small scene ends up copied to all nodes at negligible cost (Teapot, 64 nodes)", NOT_JUDGED,
           f"pages take {ratio:.2f} times as long as copies made beforehand",
           "the difference is the price of a look-up, which is fitted to the article's own cells")


def _extents(found):
    """It must hold in each scene, and a tie does not count."""
    pairs = [(found["extents", title], found["counted", title]) for title in SCENES]
    memory = [tree.database_bytes / space.database_bytes for tree, space in pairs]
    time = [tree.seconds / space.seconds for tree, space in pairs]
    yield ("A tree of extents needs less memory than a subdivision of space, but more time",
           NOT_HELD if max(memory) >= 1 else TIE if is_tie(min(time), 1) else min(time) > 1,
           f"memory {min(memory):.2f} to {max(memory):.2f}, time {min(time):.2f} to {max(time):.2f} of those in space, on one node",
           "our tree looks at eight boxes for the price of one record, and ipsc2-1994 has no prices for it")
