"""One render: its counters, nodes, film and heat maps."""

import base64
import html
import json
import pathlib
import tempfile

import pandas

from . import pictures, program


class Render:
    """What `dmpc render` did. A notebook shows its picture and what it came to.

    command   the line that was run
    stats     all counters, as stats.schema.json says what each means
    film      the picture: an array of height, width and three linear floats
    heat      for each kind asked for what each pixel took: an array of height and width
    """

    def __init__(self, command, stats, film, heat):
        self.command, self.stats, self.film, self.heat = command, stats, film, heat

    @property
    def nodes(self):
        """A row for each node, with a column for each of its figures: "pages.faults"."""
        frame = pandas.json_normalize(self.stats["nodes"])
        frame.index.name = "node"
        return frame

    def summary(self):
        """What is worth a glance, by name."""
        stats = self.stats
        figures = {
            "strategy": stats["options"]["strategy"],
            "nodes": stats["options"]["nodes"],
            "node memory (bytes)": stats["options"]["node_memory"],
            "rays": stats["rays"]["total"],
            "packets": stats["packets"]["sent"],
            "traffic (bytes)": stats["packets"]["bytes"],
        }
        if stats["pages"]:
            figures["page faults"] = stats["pages"]["faults"]
        if stats["travel"]:
            figures["messages a ray"] = stats["travel"]["messages_per_ray"]
        if stats["virtual_seconds"]:
            figures["virtual time (s)"] = stats["virtual_seconds"]["total"]
        else:
            figures["render (s)"] = stats["seconds"]["render"]
        return figures

    def __repr__(self):
        return f"<dmpc.Render of {self.stats['options']['scene']}: " + ", ".join(
            f"{name} {_shown(value)}" for name, value in self.summary().items()) + ">"

    def _repr_png_(self):
        return pictures.png(pictures.srgb(self.film))

    def _repr_html_(self):
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(_shown(value))}</td></tr>"
                       for name, value in self.summary().items())
        scene, image = html.escape(self.stats["options"]["scene"]), base64.b64encode(self._repr_png_()).decode()
        return (f'<img alt="{scene}" src="data:image/png;base64,{image}">'
                f"<table><caption>{scene}</caption><tbody>{rows}</tbody></table>")


def _shown(value):
    return f"{value:,}" if isinstance(value, int) else f"{value:.4g}" if isinstance(value, float) else str(value)


def render(options):
    """Renders what dmpc.render() was given. Raises a program.Error with what dmpc says."""
    scene, options = program.scene_of(options)
    heat = options.pop("heat", ())
    with tempfile.TemporaryDirectory(prefix="dmpc-") as folder:
        film, stats = pathlib.Path(folder, "film.exr"), pathlib.Path(folder, "stats.json")
        maps = {kind: pathlib.Path(folder, f"heat-{number}.exr") for number, kind in enumerate(program.several(heat))}
        asked = ["render", scene, *program.words(options), *(f"--heatmap={kind}:{path}" for kind, path in maps.items())]
        program.run([*asked, "--quiet", f"--stats={stats}", f"--output={film}"])
        counters = json.loads(stats.read_bytes())
        program.check_format(counters, "--stats")
        return Render(["dmpc", *asked], counters, pictures.read(film)[:, :, :3],
                      {kind: pictures.read(path)[:, :, 0] for kind, path in maps.items()})
