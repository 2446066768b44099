#include "apps/show/advice.h"

#include "apps/frontend/line/number_text.h"
#include "apps/run/many_nodes.h"

namespace dmpc::apps {

namespace {

/// A cache in which each frame has been filled so many times, on average, is far too small for its node's part of the picture.
constexpr std::uint64_t fills_a_frame = 8;

bool are_given(const RenderOptions& options) {
  return options.database.build.structure == core::Structure::extents &&
         options.database.build.page_size_bytes == many_nodes_page_bytes && options.pages.in_flight == many_nodes_in_flight;
}

/// Fewer faults than this a node cost no more than some thousand rays.
constexpr std::uint64_t faults_a_node_min = 100;

std::string many_nodes_line(const RenderOptions& options, const svm::Report& report, std::uint32_t processors) {
  const std::uint32_t nodes = options.computer.node_count;
  const bool has_faults = report.pages().faults >= nodes * faults_a_node_min;
  return are_many(nodes, processors) && has_faults && !are_given(options)
             ? "advice   " + counted(nodes, "node") + " on " + counted(processors, "processor") + " take less time with " +
                   many_nodes_options + "\n"
             : "";
}

/// The usual cache of two nodes has half of what is not at home.
std::string cache_line(const RenderOptions& options, const svm::Report& report) {
  const svm::Plan& plan = report.plan;
  const std::uint64_t frames = std::uint64_t{plan.frames} * plan.node_count();
  const std::uint32_t foreign = svm::svm_strategy()->foreign_pages_max(plan.request);
  const bool is_usual = !options.pages.cache_pages && !options.computer.node_memory_bytes;
  const bool is_half = plan.frames < foreign && foreign <= 2 * plan.frames;
  return is_usual && is_half && report.pages().faults > fills_a_frame * frames
             ? "advice   each frame of the caches was filled " + grouped(report.pages().faults / frames) +
                   " times: --cache-pages=" + std::to_string(foreign) + " holds all pages of others, in " +
                   bytes_text((foreign - plan.frames) * plan.request.page_size_bytes) + " more a node\n"
             : "";
}

}  // namespace

std::string advice_lines(const RenderOptions& options, const svm::Report& report, std::uint32_t processors) {
  const bool is_for_its_time = !options.computer.machine && options.computer.ranks == nullptr && !options.system;
  return is_for_its_time && options.strategy == Strategy::svm
             ? many_nodes_line(options, report, processors) + cache_line(options, report)
             : "";
}

}  // namespace dmpc::apps
