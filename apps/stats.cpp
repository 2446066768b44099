#include "apps/stats.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>

#include "svm/packets.h"

namespace dmpc::apps {

namespace {

using Json = nlohmann::ordered_json;
using nodes::Traffic;

constexpr double nanosecond = 1e-9;

template <class T>
Json or_null(bool applies, const T& value) {
  return applies ? Json(value) : Json(nullptr);
}

std::uint64_t ray_count(const core::Operations& operations, core::RayKind kind) {
  return operations.rays[static_cast<std::size_t>(kind)];
}

std::uint64_t ray_total(const core::Operations& operations) {
  return std::accumulate(operations.rays.begin(), operations.rays.end(), std::uint64_t{0});
}

std::uint64_t test_count(const core::Operations& operations, core::PrimitiveKind kind) {
  return operations.primitive_tests[static_cast<std::size_t>(kind)];
}

Json rays_json(const core::Operations& operations) {
  return {{"primary", ray_count(operations, core::RayKind::primary)},
          {"reflected", ray_count(operations, core::RayKind::reflected)},
          {"refracted", ray_count(operations, core::RayKind::refracted)},
          {"shadow", ray_count(operations, core::RayKind::shadow)},
          {"total", ray_total(operations)}};
}

Json hits_json(const core::Operations& operations) {
  return {{"primary", operations.primary_hits},
          {"secondary", operations.secondary_hits},
          {"shadow_blocked", operations.shadow_blocked},
          {"total_internal_reflections", operations.total_internal_reflections}};
}

Json operations_json(const core::Operations& operations) {
  return {{"cell_steps", operations.cell_steps},
          {"brick_reads", operations.brick_reads},
          {"triangle_tests", test_count(operations, core::PrimitiveKind::triangle)},
          {"sphere_tests", test_count(operations, core::PrimitiveKind::sphere)},
          {"cone_tests", test_count(operations, core::PrimitiveKind::cone)},
          {"shadings", operations.shadings},
          {"deposits_saturated", operations.deposits_saturated}};
}

Json pages_json(const svm::PageCounters& pages, std::uint64_t pixels, bool counted) {
  const double per_pixel = pixels == 0 ? 0 : static_cast<double>(pages.distinct_pages) / static_cast<double>(pixels);
  return {{"references", pages.references},
          {"hits", pages.home_hits + pages.cache_hits},
          {"home_hits", pages.home_hits},
          {"cache_hits", pages.cache_hits},
          {"misses", pages.misses},
          {"faults", pages.faults},
          {"evictions", pages.evictions},
          {"served", pages.served},
          {"distinct", or_null(counted, pages.distinct_pages)},
          {"distinct_per_pixel", or_null(counted, per_pixel)}};
}

Json work_json(const svm::WorkCounters& work) {
  return {{"pixels", work.pixels_rendered},
          {"items_asked", work.items_asked},
          {"items_taken", work.items_taken},
          {"items_given", work.items_given}};
}

Json packets_json(const nodes::NodeCounters& counters) {
  const Traffic sent = nodes::total(counters.sent);
  const Traffic received = nodes::total(counters.received);
  return {{"sent", sent.packets},
          {"received", received.packets},
          {"bytes", sent.bytes},
          {"bytes_received", received.bytes},
          {"refused", counters.refused}};
}

Json all_packets_json(const svm::Report& report) {
  const auto sent = report.sent();
  const Traffic total = nodes::total(sent);
  std::uint64_t received = nodes::total(report.host.received).packets;
  for (const svm::NodeReport& node : report.nodes) {
    received += nodes::total(node.counters.received).packets;
  }
  Json by_kind;
  for (std::size_t kind = 0; kind < svm::kind_names.size(); ++kind) {
    by_kind[svm::kind_names[kind]] = {{"packets", sent[kind].packets}, {"bytes", sent[kind].bytes}};
  }
  // Only rays overflow to the host, and in this family they do not travel.
  return {{"sent", total.packets}, {"received", received}, {"bytes", total.bytes}, {"overflow", 0}, {"by_kind", by_kind}};
}

Json memory_json(const nodes::MemoryPlan& memory) {
  Json result;
  for (std::size_t index = 0; index < nodes::category_count; ++index) {
    std::string key = nodes::name_of(static_cast<nodes::Category>(index));
    std::replace(key.begin(), key.end(), ' ', '_');
    result[key] = memory.bytes[index];
  }
  result["total"] = memory.total();
  return result;
}

/// What a seed did to the computer, or null without one.
Json chaos_json(const svm::Report& report) {
  const std::optional<nodes::Chaos>& chaos = report.plan.request.chaos;
  if (!chaos) {
    return nullptr;
  }
  std::uint64_t held = report.host.held;
  std::uint64_t sat_out = report.host.sat_out;
  for (const svm::NodeReport& node : report.nodes) {
    held += node.counters.held;
    sat_out += node.counters.sat_out;
  }
  return {{"seed", chaos->seed},
          {"packets_held", held},
          {"quanta_sat_out", sat_out},
          {"request_credits", report.plan.request_credits},
          {"film_credits", report.plan.film_credits}};
}

Json node_seconds_json(const nodes::NodeCounters& counters) {
  // The clocks differ, so that a node that never waited may seem to have been busy for longer than it ran.
  const std::uint64_t accounted_ns = counters.busy_ns + counters.asleep_ns;
  const std::uint64_t waiting_ns = counters.wall_ns > accounted_ns ? counters.wall_ns - accounted_ns : 0;
  return {{"busy", static_cast<double>(counters.busy_ns) * nanosecond},
          {"idle", static_cast<double>(counters.asleep_ns) * nanosecond},
          {"waiting", static_cast<double>(waiting_ns) * nanosecond},
          {"wall", static_cast<double>(counters.wall_ns) * nanosecond}};
}

Json node_json(const svm::NodeReport& node, bool pages_counted) {
  const svm::ProgramReport& program = node.program;
  return {{"rays", rays_json(program.operations)},
          {"hits", hits_json(program.operations)},
          {"operations", operations_json(program.operations)},
          {"pages", pages_json(program.pages, program.work.pixels_rendered, pages_counted)},
          {"packets", packets_json(node.counters)},
          {"work", work_json(program.work)},
          {"memory", {{"planned", memory_json(node.memory_planned)}, {"used", memory_json(node.memory_used)}}},
          {"seconds", node_seconds_json(node.counters)},
          {"quanta", node.counters.quanta},
          {"sleeps", node.counters.sleeps}};
}

Json nodes_json(const svm::Report& report) {
  Json result = Json::array();
  for (const svm::NodeReport& node : report.nodes) {
    result.push_back(node_json(node, report.plan.request.count_pages));
  }
  return result;
}

Json host_json(const svm::Report& report) {
  return {{"packets", packets_json(report.host)},
          {"deposits_saturated", report.host_deposits_saturated},
          {"seconds", node_seconds_json(report.host)},
          {"sleeps", report.host.sleeps}};
}

Json options_json(const RenderRecord& record) {
  const RenderOptions& options = record.options;
  const svm::Plan& plan = record.report.plan;
  const bool paged = options.strategy == svm::Strategy::svm;
  return {{"scene", options.picture.scene},
          {"width", record.report.film.width()},
          {"height", record.report.film.height()},
          {"samples", options.picture.samples},
          {"depth", options.picture.depth},
          {"convention", options.picture.convention == core::Convention::haines ? "haines" : "paper"},
          {"tracer", options.tracer == TracerChoice::grid ? "grid" : "embree"},
          {"strategy", paged ? "svm" : "replicated"},
          {"nodes", record.report.nodes.size()},
          {"node_memory", plan.node_memory_max_bytes()},
          {"page_size", record.database.page_size()},
          {"cache_pages", or_null(paged, plan.frames)},
          {"in_flight", plan.in_flight},
          {"work_item", plan.request.work_item_side},
          {"count_pages", plan.request.count_pages}};
}

Json seconds_json(const Seconds& seconds) {
  return {{"load", seconds.load},
          {"build", seconds.build},
          {"render", seconds.render},
          {"write", seconds.write},
          {"user", seconds.user},
          {"system", seconds.system},
          {"render_user", seconds.render_user},
          {"render_system", seconds.render_system}};
}

Json database_json(const core::Database& database) {
  return {{"bytes", database.bytes().size()},    {"pages", database.page_count()},
          {"page_size", database.page_size()},   {"primitives", database.header().primitive_count},
          {"references", database.references()}, {"dropped", database.dropped()}};
}

}  // namespace

std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; hash >>= 4U) {
    text[digit] = "0123456789abcdef"[hash & 15U];
  }
  return text;
}

std::string stats_json(const RenderRecord& record) {
  const svm::Report& report = record.report;
  const core::Operations operations = report.operations();
  const Json all = {{"program", "dmpc " DMPC_VERSION},
                    {"options", options_json(record)},
                    {"film_hash", hash_text(report.film.hash())},
                    {"rays", rays_json(operations)},
                    {"hits", hits_json(operations)},
                    {"operations", operations_json(operations)},
                    {"seconds", seconds_json(record.seconds)},
                    {"database", database_json(record.database)},
                    {"pages", pages_json(report.pages(), report.film.pixels().size(), report.plan.request.count_pages)},
                    {"packets", all_packets_json(report)},
                    {"work", work_json(report.work())},
                    {"chaos", chaos_json(report)},
                    {"skips", {{"empty_space", record.options.run.traversal.skip_empty_space}}},
                    {"nodes", nodes_json(report)},
                    {"host", host_json(report)}};
  return all.dump(2) + "\n";
}

}  // namespace dmpc::apps
