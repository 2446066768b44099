#include "apps/computer/task_options.h"

#include <string>

#include "apps/edge/line/option_values.h"
#include "core/base/expect.h"
#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {
namespace {

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

void check_references(const OptionSet& options, const ProgramOptions& program) {
  if (program.references && options.is_given("--in-flight") && program.tasks.in_flight != 1) {
    throw core::UsageError("--references goes with --in-flight=1: with more tasks at once their order depends on the cache");
  }
}

}  // namespace

void add_task_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own) {
  add_computer_options(options, program, own);
  add_page_group(options, program.tasks);
  add_closer_look(options, program);
  options.add_path("--references", "FILE.csv", program.references,
                   "Write which pages each node looked up in the last run, one task after the other, for dmpc study references");
  options.add_path("--heat", "FILE.csv", program.heat,
                   "Write what each task of the last run took: its node, steps, look-ups, faults, operations and, on a modelled "
                   "machine, computing");
  options.check_in_the_end([options, &program] {
    check_references(options, program);
    program.tasks.in_flight = program.references ? 1 : program.tasks.in_flight;
  });
}

}  // namespace dmpc::apps
