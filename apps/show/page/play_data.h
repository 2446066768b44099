// Data for playing a run in its page: one JSON text with a head and arrays, which the scripts in apps/show/page/play read.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/frontend/show/page/origin.h"
#include "apps/run/render_record.h"

namespace dmpc::apps::html {

/// The version of the text: incremented when a key is removed or changes its meaning.
inline constexpr int play_format = 3;

/// Pictures of more pixels are played in cells of 2x2, 4x4, ... pixels.
inline constexpr std::size_t play_cells_max = std::size_t{1} << 17U;

/// Resolution of the time at which a cell is done: this many parts of the run.
inline constexpr std::uint64_t done_parts = 65'535;

/// Requires record.view, and record.heat with the time at which pixels were done. Keys, times in nanoseconds:
///
/// - format, scene, computer, clock ("virtual time", "wall clock"), total_ns, words (of the command), nodes, step_ns, steps
/// - width, height (pixels), cell (pixels a side), wide, high (cells); the last cells of a row or column may have fewer pixels
/// - done: by cell, when its last pixel was done, in done_parts of the run, rounded up: at the end of part p all with p or less
/// are
/// - fields: [{name, meaning, unit, scale, values}] by cell: sums over its pixels; for `node` that of the pixel done last.
///   A value times `scale` is in the unit
/// - works: [{name, ns, shares}]: by node and step, in 255ths of a step, rounded so that a node's add up to its work; `ns`: sum
/// - waits: likewise, the causes of its nodes' idle time; the rest of a step is neither
/// - causes (modelled machines): {kinds, left_out_ns, count, node, begin, length, kind, peer, left, request, from, at}: the
///   longest `count` waits, by node and time, including all longer than left_out_ns; each ended by a packet of `kind` from
///   `peer`, which sent it `left` before; request: the kind that it answers, kinds.length: none; from, at: by messages alone
///   from that node at that time before the end
/// - path (modelled machines): {messages, node, from_ns, parts, kinds: [{name, ns}]} of the critical path, which goes back from
///   that moment of the node; parts add up to total_ns, kinds except computing and service while busy
/// - topology (modelled machines): {kind, columns (of a mesh or torus, else 1), uplinks}
/// - pairs: {what, row, column, side, counts} or, where that takes less, {..., places, counts}: of row * side + column
/// - over (modelled machines): traffic over time, each {step_ns, steps, most, values} by row and step; in 255ths of `most`:
///   links: bytes by link; pairs: packets {what} by row * side + column, if there are not too many; pages: fetches by page;
///   levels: [{name, ...}]: the maximum of each node in a step, summed
/// - links: [[from, to, messages, bytes, held_ns, waited_ns]], the busiest (modelled machines)
/// - forecast (svm on modelled machines, if references were recorded): json_of() of a ForecastView
/// - stats: the contents of --stats, without lists of nodes, links, ranks, pairs and heat maps
/// - pages: [[number, home, fetched]], the hottest (svm); fetched: of all pages
nlohmann::json play_data(const RenderRecord& record, const Origin& origin);

}  // namespace dmpc::apps::html
