// The caches of a run, for which a user's policy decides in a process of its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "apps/frontend/system/child_process.h"
#include "apps/frontend/system/descriptor.h"
#include "apps/policy/policy_process.h"
#include "apps/policy/request.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {

/// One process for all nodes. It hears of hits and inserts in batches, at the latest when it is asked for a victim. Whatever goes
/// wrong throws core::InputError with option and place, as ForeignPolicy::misses() does, and the process ends with this. Takes
/// none of a node's memory.
class ForeignRun final : public svm::OwnPolicyRun {
 public:
  /// Starts the process. `check` is called while it is waited for, and may throw. `place` outlives this.
  ForeignRun(const PolicyPlace& place, std::function<void()> check);

  std::unique_ptr<svm::ReplacementPolicy> make(const svm::PolicySite& site) override;
  void finish() override;

  /// To be called by what make() returns.
  void tell(const PolicyEvent& event);
  std::uint32_t ask(const PolicyEvent& event);
  [[noreturn]] std::uint32_t refuse_answer() const;

 private:
  void flush();
  void send(const void* bytes, std::size_t count);
  std::size_t receive(void* answer, std::size_t count);
  void wait_for(short events);
  [[noreturn]] void fail();

  const PolicyPlace& place_;
  std::function<void()> check_;
  std::vector<PolicyEvent> untold_;
  std::uint64_t flush_count_ = 0;
  Descriptor its_, ours_;  ///< the ends of a socket
  ChildProcess process_;
};

}  // namespace dmpc::apps
