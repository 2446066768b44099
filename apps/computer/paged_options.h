// The options of a program of tasks: those of any program on the computer, and what pages and caches are like.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/options.h"
#include "core/trace/charge.h"
#include "svm/pages/task_plan.h"

namespace dmpc::apps {

struct PagedOptions {
  ProgramOptions program;
  svm::TaskOptions tasks;                           ///< the computer is the program's
  std::optional<std::filesystem::path> references;  ///< where those of the last run go, as CSV
  std::optional<std::filesystem::path> heat;        ///< where what each task of the last run took goes, as CSV
};

/// Declares them, and which go together.
void add_options(OptionSet options, PagedOptions& paged, const std::vector<NumberOption>& own);

/// What the computer below calls a program's operation, between those of pages.
core::Charge charge_of(Index operation);

/// Reads the machine that is to be modelled, if one is. Look-ups and installs of pages keep its prices. Throws core::InputError
/// as load_machine() does, core::UsageError for too many operations.
void choose_machine(PagedOptions& options, const std::vector<OperationNeed>& operations);

}  // namespace dmpc::apps
