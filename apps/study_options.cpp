#include "apps/study_options.h"

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/region_options.h"
#include "core/expect.h"
#include "dataflow/bsp.h"

namespace dmpc::apps {
namespace {

[[noreturn]] void refuse_node_counts(std::string_view text) {
  throw core::UsageError("--nodes=" + std::string(text) + ": expected numbers from 1 to " +
                         std::to_string(dataflow::region_count_max) + " with commas between them, such as 4,8,16");
}

std::vector<std::uint32_t> parse_node_counts(std::string_view text) {
  std::vector<std::uint32_t> counts;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (bool is_last = false; !is_last; ++at) {
    const auto [rest, error] = std::from_chars(at, end, counts.emplace_back());
    is_last = rest == end;
    if (error != std::errc() || counts.back() < 1 || counts.back() > dataflow::region_count_max || (!is_last && *rest != ',')) {
      refuse_node_counts(text);
    }
    at = rest;
  }
  return counts;
}

/// "4,8,16".
std::string listed(const std::vector<std::uint32_t>& counts) {
  std::string text;
  for (const std::uint32_t count : counts) {
    text += (text.empty() ? "" : ",") + std::to_string(count);
  }
  return text;
}

void add_node_counts(OptionSet& set, std::vector<std::uint32_t>& counts) {
  set.add_text(
      "--nodes", "N,N,... [" + listed(counts) + "]", [&counts](const std::string& text) { counts = parse_node_counts(text); },
      "Nodes of the computers, one after the other");
}

/// One overload a study: its own options, and examples.
struct AddOwn {
  OptionSet& set;

  void operator()(BalanceStudy& study) const {
    add_node_counts(set, study.node_counts);
    add_region_options(set, study.regions, study.topology);
    set.add_flag("--per-node", study.per_node, "Show each node's share of the work, too");
    set.set_examples(
        "Examples:\n"
        "  dmpc study balance rings-3-t1\n"
        "  dmpc study balance teapot-12 --nodes=16 --topology=torus --per-node --format=csv -o teapot.csv");
  }
  void operator()(TrafficStudy& study) const {
    add_node_counts(set, study.node_counts);
    set.set_examples(
        "Examples:\n"
        "  dmpc study traffic teapot-12\n"
        "  dmpc study traffic rings-4-t1 --nodes=8,64 --resolution=256x256 --format=json -o rings.json");
  }
};

}  // namespace

void add_options(OptionSet set, StudyOptions& options) {
  add_options(set, options.picture);
  add_axes_option(set, options.axes);
  std::visit(AddOwn{set}, options.study);
  set.add_choice<TableFormat>("--format", options.format,
                              {{"markdown", TableFormat::markdown}, {"csv", TableFormat::csv}, {"json", TableFormat::json}},
                              "How the table is written");
  set.add_path("-o,--output", "FILE [stdout]", options.output, "Where it goes");
}

}  // namespace dmpc::apps
