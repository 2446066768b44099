// What the page of a render plays: one JSON text with a head and arrays, which the scripts in apps/show/page/play read.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/frontend/show/page/origin.h"
#include "apps/run/render_record.h"

namespace dmpc::apps::html {

/// Of the text: counted up when a key goes or comes to mean something else.
inline constexpr int play_format = 3;

/// Pictures of more pixels are played in cells of 2x2, 4x4, ... pixels.
inline constexpr std::size_t play_cells_max = std::size_t{1} << 17U;

/// When cells are done is told in so many parts of the run.
inline constexpr std::uint64_t done_parts = 65'535;

/// Requires record.view, and record.heat with the time at which pixels were done. Keys, times in nanoseconds:
///
/// - format, scene, computer, clock ("virtual time", "wall clock"), total_ns, words (of the command), nodes, step_ns, steps
/// - width, height (pixels), cell (pixels a side), wide, high (cells); the last cells of a row or column may have fewer pixels
/// - done: by cell, when its last pixel was, in done_parts of the run, rounded up: at the end of part p what has p or less is
/// done
/// - fields: [{name, meaning, unit, scale, values}] by cell: sums over its pixels; of `node` that of the pixel done last.
///   A value times `scale` is in the unit
/// - works: [{name, ns, shares}]: by node and step, in 255ths of a step, rounded so that a node's add up to what it did; `ns`:
/// sum
/// - waits: likewise, what its nodes had nothing to do for; what is left of a step is neither
/// - causes (modelled machines): {kinds, left_out_ns, count, node, begin, length, kind, peer, left, request, from, at}: the
/// longest of
///   `count` waits, by node and time, of which none longer than left_out_ns is missing; they ended by a packet of `kind` of
///   `peer`, which left it so long before; request: the kind that it answers, kinds.length: none; from, at: by messages alone
///   from that node at so long before the end
/// - path (modelled machines): {messages, node, from_ns, parts, kinds: [{name, ns}]} of the critical path, which goes back from
/// that
///   moment of the node; parts add up to total_ns, kinds but for computing and service while busy
/// - topology (modelled machines): {kind, columns (of a mesh or torus, else 1), uplinks}
/// - pairs: {what, row, column, side, counts} or, where that takes less, {..., places, counts}: of row * side + column
/// - over (modelled machines): what passed over time, each {step_ns, steps, most, values} by row and step; with `most` in 255ths
/// of that:
///   links: bytes by link; pairs: packets {what} by row * side + column, if there are not too many; pages: fetches by page;
///   levels: [{name, ...}]: the most of each node in a step, summed
/// - links: [[from, to, messages, bytes, held_ns, waited_ns]], the busiest (modelled machines)
/// - forecast (svm on modelled machines, if references were kept): json_of() of a ForecastView
/// - stats: what --stats writes, without lists of nodes, links, ranks, pairs and heat maps
/// - pages: [[number, home, fetched]], the hottest (svm); fetched: of all pages
nlohmann::json play_data(const RenderRecord& record, const Origin& origin);

}  // namespace dmpc::apps::html
