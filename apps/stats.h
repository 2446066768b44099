// What a render counted, as JSON with stable keys. Its .cpp is the only one that names nlohmann-json.
#pragma once

#include <cstdint>
#include <string>

#include "apps/render_options.h"
#include "core/database.h"
#include "svm/run.h"

namespace dmpc::apps {

/// Seconds of wall clock by phase, and of processor time.
struct Seconds {
  double load = 0, build = 0, render = 0, write = 0;
  double user = 0, system = 0;                ///< of the whole process so far
  double render_user = 0, render_system = 0;  ///< of the phase `render` alone
};

/// All that is known about one render.
struct RenderRecord {
  const RenderOptions& options;
  const core::Database& database;
  const svm::Report& report;
  Seconds seconds;
};

/// One JSON object, indented, with a line end. The keys are an interface; what does not apply is null, and no number is NaN or
/// infinite.
///   program        name and version
///   options        what was asked for and what it became: scene, width, height, samples, depth, convention, tracer, strategy,
///                  nodes, node_memory (bytes a node, the most), page_size, cache_pages, in_flight, work_item, count_pages
///   film_hash      of the film's integers, 16 hexadecimal digits: equal pictures, equal hashes
///   rays           primary, reflected, refracted, shadow, total
///   hits           primary, secondary, shadow_blocked, total_internal_reflections
///   operations     cell_steps, brick_reads, triangle_tests, sphere_tests, cone_tests, shadings, deposits_saturated
///   seconds        load, build, render, write (wall clock), user, system, render_user, render_system
///   database       bytes, pages, page_size, primitives, references, dropped
///   pages          references, hits, home_hits, cache_hits, misses, faults, evictions, served, distinct, distinct_per_pixel
///   packets        sent, received, bytes, overflow, and by_kind: packets and bytes
///   skips          empty_space: whether the short cut was on
///   work           pixels, items_asked, items_taken, items_given
///   nodes          for each node: rays, hits, operations, pages, packets, work, memory {planned, used: bytes by category and in
///                  total}, seconds {busy: computing, idle: asleep for want of packets, waiting for a core, wall},
///                  quanta, sleeps
///   host           packets, deposits_saturated (on its film, over those of the nodes), seconds, sleeps
std::string stats_json(const RenderRecord& record);

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace dmpc::apps
