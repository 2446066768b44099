#include "apps/reader/confinement.h"

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::optional<Confinement> readers;

}  // namespace

void add_sandbox_option(OptionSet options, Sandbox& sandbox) {
  options.add_choice<Sandbox>("--sandbox", sandbox, {{"available", Sandbox::available}, {"required", Sandbox::required}},
                              "If this computer cannot fully confine the processes that read foreign files (seccomp, limits, "
                              "Landlock): print a note, or read nothing");
}

std::string missing_text(const Confinement& confinement) {
  core::expect(!confinement.is_full(), "something is missing");
  std::string words;
  const auto add = [&words](bool holds, const char* word) {
    words += holds ? "" : (words.empty() ? "" : ", ") + std::string(word);
  };
  add(confinement.are_calls_filtered, "no filter of system calls (seccomp)");
  add(confinement.are_limits_set, "not all limits of memory, files and processes");
  add(confinement.are_files_forbidden, "files not forbidden (Landlock)");
  add(confinement.are_calls_filtered || confinement.is_reach_forbidden,
      "network, devices and signals not forbidden (Landlock of kernel 6.12)");
  add(confinement.ends_with_dmpc, "no end with dmpc's own (PR_SET_PDEATHSIG)");
  return "this computer does not confine the processes that read foreign files as it should: " + words;
}

void add_reader(const Confinement& confinement) {
  const Confinement before = readers.value_or(Confinement{true, true, true, true, true});
  readers = {.are_calls_filtered = before.are_calls_filtered && confinement.are_calls_filtered,
             .are_limits_set = before.are_limits_set && confinement.are_limits_set,
             .are_files_forbidden = before.are_files_forbidden && confinement.are_files_forbidden,
             .is_reach_forbidden = before.is_reach_forbidden && confinement.is_reach_forbidden,
             .ends_with_dmpc = before.ends_with_dmpc && confinement.ends_with_dmpc};
}

std::optional<Confinement> confinement_of_readers() { return readers; }

}  // namespace dmpc::apps
