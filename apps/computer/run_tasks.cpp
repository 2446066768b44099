// Runs a program of tasks over pages, from its options to its results.
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/computer/bounded_charge.h"
#include "apps/computer/dmpc/pages.h"
#include "apps/computer/on_ranks.h"
#include "apps/computer/options.h"
#include "apps/computer/program_main.h"
#include "apps/computer/program_observer.h"
#include "apps/computer/program_outputs.h"
#include "apps/computer/rank_rounds.h"
#include "apps/computer/record.h"
#include "apps/computer/vocabulary.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/run/computer_capacity.h"
#include "apps/frontend/run/option_words.h"
#include "apps/frontend/system/digest.h"
#include "apps/frontend/system/stopwatch.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "svm/pages/packets.h"
#include "svm/pages/page.h"
#include "svm/pages/replacement.h"
#include "svm/pages/run_tasks.h"

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
      "Page size, a power of two from 512B to 64KiB");
  options.add_number("--cache-pages", tasks.cache_pages, 1, 0x7fffffff, "a quarter of all, at least 64",
                     "Pages of other nodes that a node can cache");
  OptionSet::Choices<svm::Replacement> policies;
  for (const svm::PolicyKind& kind : svm::policy_kinds()) {
    policies.emplace_back(kind.name, static_cast<svm::Replacement>(policies.size()));
  }
  options.add_choice<svm::Replacement>("--replacement", tasks.replacement, policies, "Replacement policy of the page cache");
  options.add_number("--in-flight", tasks.in_flight, 1, svm::in_flight_max, "16", "Tasks that a node works on at once");
}

void check_references(const OptionSet& options, const ProgramOptions& program) {
  if (program.references && options.is_given("--in-flight") && program.tasks.in_flight != 1) {
    throw core::UsageError("--references goes with --in-flight=1: with more tasks at once their order depends on the cache");
  }
}

/// Declares all options of such a program and their compatibility checks.
void add_task_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own) {
  add_computer_options(options, program, own);
  add_page_group(options, program.tasks);
  add_closer_look(options, program);
  options.add_path(
      "--references", "FILE.csv", program.references,
      "Write the pages that each node looked up in the last run, one task after the other, for dmpc study references");
  options.add_path("--heat", "FILE.csv", program.heat,
                   "Write what each task of the last run took: its node, steps, look-ups, faults, operations and, on a modelled "
                   "machine, computing");
  options.check_in_the_end([options, &program] {
    check_references(options, program);
    program.tasks.in_flight = program.references ? 1 : program.tasks.in_flight;
  });
}

/// The offsets that a task may access.
struct PagesBounds {
  std::size_t data_bytes = 0;  ///< up to the end of the last page
  std::size_t operation_count = 0;
};

/// A task's view of a node's pager, for the duration of a step.
template <class Records>
class PagesOf final : public Pages {
 public:
  PagesOf(Records& records, nodes::Charges& charges, const PagesBounds& bounds)
      : records_(records), charges_(charges), bounds_(bounds) {}

  const std::byte* find(std::uint64_t offset) override {
    if (offset % find_alignment != 0 || offset >= bounds_.data_bytes) {
      throw ProgramError("the place " + std::to_string(offset) + " is looked up: expected a multiple of 8 within " +
                         std::to_string(bounds_.data_bytes) + " bytes");
    }
    const core::Address address{static_cast<std::uint32_t>(offset / core::record_alignment)};
    const std::byte* const place = records_.find(address);
    absent_ = place == nullptr ? address : absent_;
    return place;
  }
  void charge(Index operation, std::uint64_t count) override {
    if (operation >= bounds_.operation_count) {
      throw ProgramError("operation " + std::to_string(operation) + " is charged: " + std::to_string(bounds_.operation_count) +
                         " are declared");
    }
    charge_within_bounds(charges_[charge_of(operation)], count, std::to_string(operation));
  }
  /// Returns the last address that was absent.
  core::Address absent() const {
    if (absent_ == core::no_address) {
      throw ProgramError("a task says that a page is absent, but all that it looked up was there");
    }
    return absent_;
  }

 private:
  Records& records_;
  nodes::Charges& charges_;
  const PagesBounds& bounds_;
  core::Address absent_ = core::no_address;
};
static_assert(find_alignment == core::record_alignment);

core::TaskState state_of(Step step) {
  return step == Step::finished ? core::TaskState::finished
         : step == Step::more   ? core::TaskState::more
                                : core::TaskState::absent;
}

template <class Records>
svm::TaskKind<Records> kind_of(const AnyTask& task, const PagesBounds& bounds) {
  return {.sizes = {.task_bytes = core::round_up(task.task_bytes, std::size_t{64}), .result_bytes = task.result_bytes},
          .start = task.make,
          .run =
              [&task, bounds](std::byte* place, Records& records, nodes::Charges& charges, core::Address& absent) {
                PagesOf<Records> pages(records, charges, bounds);
                const Step step = task.run(place, pages);
                absent = step == Step::absent ? pages.absent() : absent;
                return state_of(step);
              },
          .put_result = task.put_result};
}

/// Describes what all ranks must agree on before they run tasks.
std::string words_of_run(std::uint32_t number, std::uint32_t count, const svm::TaskKinds& kinds, std::span<const std::byte> data,
                         bool has_unique_bytes) {
  const std::string words = "run " + std::to_string(number) + " of " + counted(count, "task") + " of " +
                            bytes_text(kinds.plain.sizes.task_bytes) + " over " + bytes_text(data.size());
  if (!has_unique_bytes) {
    return words;
  }
  Digest digest;
  digest.add(data);
  return words + " of data " + hash_text(digest.value());
}

class AskedComputer final : public PagedComputer {
 public:
  /// `rounds` coordinates the ranks, if there are any.
  AskedComputer(const ProgramOptions& options, ProgramRecord& record, const Interrupt& interrupt, RankRounds* rounds)
      : options_(options), record_(record), interrupt_(interrupt), rounds_(rounds) {}

  std::uint32_t node_count() const override { return options_.computer.node_count; }
  std::size_t page_bytes() const override { return options_.tasks.page_size_bytes; }
  /// Puts the observations of the last run into the record. Call it once, at the end.
  void take_run_profile() {
    if (last_observer_) {
      last_observer_->take(record_);
    }
  }

 private:
  void run_any(std::span<const std::byte> data, bool has_unique_bytes, std::uint32_t count, const AnyTask& task,
               std::byte* results) override {
    const std::vector<std::byte> whole_pages = padded(data);
    const PagesBounds bounds = {whole_pages.size(), record_.vocabulary.operations.size()};
    const svm::TaskKinds kinds = {kind_of<svm::Pager>(task, bounds), kind_of<svm::RecordingPager>(task, bounds)};
    const std::span<std::byte> all_results(results, count * task.result_bytes);
    if (rounds_ == nullptr) {
      return run_kinds(kinds, whole_pages, count, all_results);
    }
    const std::string next = words_of_run(record_.tasks.run_count + 1, count, kinds, whole_pages, has_unique_bytes);
    rounds_->here([&] { rounds_->agree(next); });
    run_kinds(kinds, whole_pages, count, all_results);
    rounds_->here([&] { rounds_->share(all_results); });
  }

  std::vector<std::byte> padded(std::span<const std::byte> data) const {
    std::vector<std::byte> whole_pages(data.begin(), data.end());
    whole_pages.resize(core::round_up(std::max<std::size_t>(data.size(), 1), page_bytes()));
    return whole_pages;
  }

  /// With ranks only rank 0 gets all results.
  void run_kinds(const svm::TaskKinds& kinds, std::span<const std::byte> data, std::uint32_t count,
                 std::span<std::byte> results) {
    const auto plan =
        with_options_named(computer_words, [&] { return svm::TaskPlan(options_.tasks, data.size(), count, kinds.plain.sizes); });
    check_room(plan);
    const WatchedRun watched = {plan.node_count(), plan.pages().page_count, count};
    last_observer_ = std::make_unique<ProgramObserver>(options_, record_.vocabulary, watched);
    const auto take = [&](std::uint32_t first, std::string_view bytes) {
      std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<char*>(&results[first * kinds.plain.sizes.result_bytes]));
    };
    svm::TaskWatching watching = last_observer_->watching();
    watching.communicate = [this](const std::function<void()>& run) {
      rounds_->here([&] {
        rounds_->meet();
        run();
      });
    };
    Stopwatch stopwatch;
    const svm::TaskFigures figures = svm::run_tasks_of_kind(kinds, plan, data, watching, interrupt_.token(), take);
    if (figures.end == nodes::RunEnd::interrupted) {
      throw Interrupted{};
    }
    record_.wall_seconds += stopwatch.lap();
    record_.add(figures, plan, count);
  }

  void check_room(const svm::TaskPlan& plan) const {
    std::vector<nodes::PeerMemory> peers;
    for (std::uint32_t node = 0; node < plan.node_count(); ++node) {
      peers.push_back({plan.mailbox(), plan.node_memory(node).total()});
    }
    peers.push_back({{}, plan.host_memory().total()});
    const nodes::RankLinks* const links = plan.computer().ranks;
    apps::check_room(nodes::rank_memory(peers, links, links == nullptr ? 0 : links->rank()));
  }

  const ProgramOptions& options_;
  ProgramRecord& record_;
  const Interrupt& interrupt_;
  RankRounds* rounds_;
  std::unique_ptr<ProgramObserver> last_observer_;
};

int end_tasks(AskedComputer& computer, ProgramRecord& record, const ProgramOutputs& outputs) {
  if (record.tasks.run_count == 0) {
    throw ProgramError("no tasks were run");
  }
  computer.take_run_profile();
  return end_program(record, outputs);
}

/// Runs the tasks; with ranks, this rank's part.
int act_on_pages(const ProgramCall& call, ProgramOptions& options, const Vocabulary& vocabulary,
                 const PagedApplication& application, const Interrupt& interrupt, RankRounds* rounds) {
  const ProgramOutputs outputs = outputs_of(options);
  if (rounds == nullptr || rounds->is_first()) {
    check_outputs(options, outputs);
  }
  options.tasks.computer = options.computer;
  ProgramRecord record{.name = call.name, .options = options, .vocabulary = vocabulary};
  AskedComputer computer(options, record, interrupt, rounds);
  if (rounds == nullptr) {
    record.result = application.act(computer);
    return end_tasks(computer, record, outputs);
  }
  record.result = rounds->apart([&] { return application.act(computer); });  // on all ranks, with the same results
  rounds->agree("the end");
  rounds->meet();
  return rounds->is_first() ? rounds->apart([&] { return end_tasks(computer, record, outputs); }) : 0;
}

int run_paged(const ProgramCall& call, ProgramOptions& options, const PagedApplication& application, const Interrupt& interrupt) {
  const Vocabulary vocabulary = vocabulary_of_tasks(application.operations);
  choose_machine(options, vocabulary);
  if (options.runner != RunnerKind::mpi) {
    return act_on_pages(call, options, vocabulary, application, interrupt, nullptr);
  }
  const auto needs = [&]() -> RankNeeds { return {.payload_bytes_max = svm::page_reply_bytes(options.tasks.page_size_bytes)}; };
  return run_on_ranks(options, call, needs, [&](RankRounds& rounds) {
    return act_on_pages(call, options, vocabulary, application, interrupt, &rounds);
  });
}

}  // namespace

}  // namespace dmpc::apps

namespace dmpc {

int run_tasks(int count, const char* const* words, const PagedApplication& application) {
  apps::ProgramOptions options;
  return apps::run_main(
      count, words,
      {.description = application.description,
       .declare = [&](apps::OptionSet set) { apps::add_task_options(set, options, application.options); },
       .runner = options.runner,
       .act = [&](const apps::ProgramCall& call,
                  apps::Interrupt& interrupt) { return apps::run_paged(call, options, application, interrupt); }});
}

}  // namespace dmpc
