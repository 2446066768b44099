#include "apps/computer/paged_options.h"

#include <array>
#include <string>
#include <utility>

#include "apps/computer/declared.h"
#include "apps/computer/dmpc/pages.h"
#include "apps/edge/line/option_values.h"
#include "core/base/expect.h"
#include "core/trace/charge.h"
#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {
namespace {

using core::Charge;

constexpr std::array<Charge, task_operations_max> free_charges = {Charge::ray_setup,     Charge::cell_step,   Charge::brick_read,
                                                                  Charge::triangle_test, Charge::sphere_test, Charge::cone_test,
                                                                  Charge::shading,       Charge::ray_packing};
constexpr Charge page_charges[] = {Charge::home_lookup, Charge::cached_lookup, Charge::page_install};

std::size_t page_size_of(const std::string& text) {
  const std::size_t bytes = parse_size_bytes(text, "--page-size");
  if (!svm::is_page_size(bytes)) {
    throw core::UsageError("--page-size=" + text + ": expected a power of two from 512B to 64KiB");
  }
  return bytes;
}

void add_page_group(OptionSet& options, svm::TaskOptions& tasks) {
  options.begin_group("The pages");
  options.add_text(
      "--page-size", "SIZE [1KiB]", [&tasks](const std::string& text) { tasks.page_size_bytes = page_size_of(text); },
      "Size of a page, a power of two from 512B to 64KiB");
  options.add_number("--cache-pages", tasks.cache_pages, 1, 0x7fffffff, "a quarter of all, at least 64",
                     "Pages of other nodes that a node can keep");
  OptionSet::Choices<svm::Replacement> policies;
  for (const svm::PolicyKind& kind : svm::policy_kinds()) {
    policies.emplace_back(kind.name, static_cast<svm::Replacement>(policies.size()));
  }
  options.add_choice<svm::Replacement>("--replacement", tasks.replacement, policies, "Which of them makes room for another");
  options.add_number("--in-flight", tasks.in_flight, 1, svm::in_flight_max, "16", "Tasks that a node works on at once");
}

void check_references(const OptionSet& options, const PagedOptions& paged) {
  if (paged.references && options.is_given("--in-flight") && paged.tasks.in_flight != 1) {
    throw core::UsageError("--references goes with --in-flight=1: with more tasks at once their order depends on the cache");
  }
}

}  // namespace

void add_options(OptionSet options, PagedOptions& paged, const std::vector<NumberOption>& own) {
  add_computer_options(options, paged.program, own);
  add_page_group(options, paged.tasks);
  add_closer_look(options, paged.program);
  options.add_path("--references", "FILE.csv", paged.references,
                   "Write which pages each node looked up in the last run, one task after the other, for dmpc study references");
  options.add_path("--heat", "FILE.csv", paged.heat,
                   "Write what each task of the last run took: its node, steps, look-ups, faults, operations and, on a modelled "
                   "machine, computing");
  options.check_in_the_end([options, &paged] {
    check_references(options, paged);
    paged.tasks.in_flight = paged.references ? 1 : paged.tasks.in_flight;
  });
}

core::Charge charge_of(Index operation) { return free_charges.at(operation); }

void choose_machine(PagedOptions& options, const std::vector<OperationNeed>& operations) {
  check_operations(operations, task_operations_max, "a program of tasks");
  options.program.computer.machine = asked_machine(options.program);
  if (options.program.computer.machine) {
    nodes::Machine& machine = *options.program.computer.machine;
    const double slowdown = slowdown_of(machine);
    const auto given_ps = std::exchange(machine.cost_ps, {});
    for (const Charge charge : page_charges) {
      machine.cost_ps[static_cast<std::size_t>(charge)] = given_ps[static_cast<std::size_t>(charge)];
    }
    for (Index i = 0; i < operations.size(); ++i) {
      machine.cost_ps[static_cast<std::size_t>(charge_of(i))] = price_ps(operations[i], slowdown);
    }
  }
}

}  // namespace dmpc::apps
