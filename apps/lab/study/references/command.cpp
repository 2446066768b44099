#include "apps/lab/study/references/command.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/geometric_sizes.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/study/cache_curves.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/lab/study/references/gzip_text.h"

namespace dmpc::apps {
namespace {

constexpr const char* references_data_file = "references.csv";
constexpr std::uint32_t references_size_count = 12;

/// Shows the number of caches fed, on a terminal. Thread safety: any thread may call count().
class CachesFed {
 public:
  CachesFed(std::uint64_t total, bool is_shown) : progress_(std::cerr, is_shown, "study references: ", "caches"), total_(total) {}
  void count() {
    const std::scoped_lock lock(mutex_);
    progress_.update(++fed_, total_);
  }

 private:
  std::mutex mutex_;
  Progress progress_;
  std::uint64_t fed_ = 0, total_;
};

std::vector<CacheCurves::NodeReferences> references_of(const ReferenceTrace& trace) {
  std::vector<CacheCurves::NodeReferences> nodes;
  for (std::size_t node = 0; node < trace.nodes.size(); ++node) {
    nodes.push_back({trace.nodes[node]});
    if (!trace.prices.empty()) {
      nodes.back().prices = trace.prices[node];
    }
  }
  return nodes;
}

std::vector<Plot> plots_of(const ReferencesOptions& options, CacheCurves::Policies policies) {
  std::vector<Plot> plots = {CacheCurves::plot(policies)};
  if (options.columns.price) {
    plots.push_back(CacheCurves::cost_plot(policies));
  }
  return plots;
}

TableFiles files_of(const ReferencesOptions& options) {
  std::vector<NamedFile> inputs;
  if (options.file != "-") {
    inputs.push_back({"FILE", options.file});
  }
  return {options.table, {names_of(references_data_file, plots_of(options, {}))}, {.inputs = std::move(inputs)}};
}

Table table_of(const ReferenceTrace& trace, const ReferencesOptions& options, CacheCurves::Policies policies,
               const Interrupt& interrupt) {
  Table table("Study references of " + options.file + ": " + counted(trace.reference_count, "reference") + " of " +
                  counted(trace.page_count, "page") + " by " + counted(trace.nodes.size(), "node"),
              CacheCurves::columns("share of pages", policies, options.columns.price.has_value()));
  const std::vector<std::uint32_t> sizes =
      options.cache_pages.empty() ? geometric_sizes(trace.page_count, references_size_count) : options.cache_pages;
  CachesFed fed(CacheCurves::cache_count(trace.nodes.size(), sizes.size(), policies), !options.quiet && stderr_is_terminal());
  const CacheCurves curves(references_of(trace), trace.reference_count, sizes, policies,
                           {.check = [&interrupt] { interrupt.check(); }, .fed = [&fed] { fed.count(); }});
  curves.add_rows(trace.page_count, table);
  table.add_note(
      "Each node has a cache of its own, and faults are those of all. Share of pages: the cache of one node over all "
      "that are referenced. Misses are given as a share of all references.");
  table.add_note(CacheCurves::note());
  if (options.columns.price) {
    table.add_note("Cost: the sum of the faults' prices, from the column " + *options.columns.price +
                   ". The optimum has the fewest faults, which need not cost least.");
  }
  table.add_note(curves.needs_note());
  return table;
}

}  // namespace

void add_options(OptionSet set, ReferencesOptions& options) {
  set.add_argument(
      "FILE", [&options](const std::string& text) { options.file = text; },
      "A CSV file, perhaps packed by gzip, whose first line names its columns: page, and perhaps node; others are passed over. - "
      "is the standard input");
  set.add_text(
      "--page-column", "NAME [page]", [&options](const std::string& text) { options.columns.page = text; },
      "The column that has the page");
  set.add_text(
      "--node-column", "NAME [node]", [&options](const std::string& text) { options.columns.node = text; },
      "The column that has the node; without one all references are one node's");
  set.add_text(
      "--price-column", "NAME", [&options](const std::string& text) { options.columns.price = text; },
      "The column that has what a miss costs, such as bytes: policies are then compared by the sum of these prices, too");
  add_cache_pages(set, options.cache_pages);
  add_policies(set, options.policies);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc study references trace.csv\n"
      "  dmpc study references trace.csv.gz --page-column=block --node-column=thread\n"
      "  zstdcat trace.csv.zst | dmpc study references -\n"
      "  dmpc study references trace.csv --cache-pages=16,64,256 --plots=plots --format=csv -o misses.csv\n"
      "  dmpc study references trace.csv --price-column=bytes\n"
      "  dmpc study references trace.csv --policy=python:$HOME/oldest.py:Oldest\n"
      "A page is a whole number, whatever it stands for: the references may be any program's.");
}

int study_references_command(const ReferencesOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  const std::vector<ForeignPolicy> policies = load_policies(options.policies, [&interrupt] { interrupt.check(); });
  const ReferenceTrace trace = [&] {
    const Interrupt::EndAtOnce end_at_once(interrupt);
    return read_references(std::filesystem::path(options.file), options.columns,
                           [](std::istream& packed) { return std::make_unique<GzipText>(packed); });
  }();
  std::optional<Table> table;
  const auto result = [&](bool) {
    return study_result({.title = "Study references of " + options.file,
                         .table = *table,
                         .data_file = references_data_file,
                         .plots = plots_of(options, policies)},
                        options.table.format);
  };
  return run_tabled(
      {.measure = [&] { table = table_of(trace, options, policies, interrupt); }, .consequence = "nothing was written"}, result,
      files, interrupt, output);
}

}  // namespace dmpc::apps
