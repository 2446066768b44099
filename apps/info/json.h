// The results of `dmpc info` as JSON with stable keys.
#pragma once

#include <string>

namespace dmpc::apps {

struct InfoRecord;

/// One JSON object, indented, with a line end. The keys are an interface; what does not apply is null, and no number is NaN or
/// infinite. Sizes are in bytes, points and extents [x, y, z] in the scene's coordinates, times in seconds of wall clock.
/// - program: name and version
/// - scene: name or path
/// - objects: polygon, patch, textured, sphere, cone (how many of each), total
/// - primitives: count, dropped (degenerate ones: no area or length, radius 0, or not finite), copies (in leaves of all cells)
/// - rounding, what it takes from the picture, 0 where that is nothing: moved (primitives that may be off), moved_pixels (by how
///   much, at most), collapsed (of the dropped ones, those that have a size in the file), collapsed_pixels (the largest's)
/// - bounds: low, high, extent; null if nothing is finite
/// - view: camera (what --camera takes), from, at, up, degrees, width and height (pixels of the picture)
/// - background: red, green, blue, linear
/// - lights, for each: light (what --light takes), position, color
/// - materials: count, mirroring, transmitting, textured
/// - textures, for each: name, width, height, levels, format, tiles, tile_bytes, table_bytes
/// - database: bytes, pages, page_size, bytes_per_primitive, copies_per_primitive, primitives_per_leaf, cells and macro_cells
///   (along x, y, z), occupied_macro_cells, levels_max (BVH nodes from a macro cell to a leaf), records (for each kind: kind,
///   count, bytes), unused_bytes (between records)
/// - build_peak: the most memory that this process held until the database was built, libraries included: a render holds
///   more than this, and more than `all` below
/// - regions, of dataflow: balance (equal-size or subsampled)
/// - computers, for each number of nodes: nodes, and for svm, replicated and dataflow (null where that takes fewer nodes), by
///   the default options of a render on threads: least (the least memory of a node, with less a render is refused),
///   least_together (of all nodes), usual (of the largest node, without --node-memory), all (of all nodes and the host,
///   likewise); dataflow_copies (of a primitive, over all regions)
/// - seconds: load, build, regions
std::string info_json(const InfoRecord& record);

}  // namespace dmpc::apps
