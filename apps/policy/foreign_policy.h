// A user-defined replacement policy, a Python class or a shared library, which runs in its own process.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/policy/policy_process.h"
#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {

/// Faults, and the sum of their prices.
struct PricedFaults {
  std::uint64_t count = 0, cost = 0;
};

/// The policy's code runs in child processes that see only the references; if it crashes, hangs or exits, this process is not
/// affected. Thread safety: an immutable value.
class ForeignPolicy final : public svm::OwnPolicy {
 public:
  static constexpr const char* places = "FILE.so|python:FILE.py:CLASS";  ///< for help
  /// Whether a text names a place, rather than one of dmpc's own policies.
  static bool is_place(const std::string& text) { return text.starts_with("python:") || text.find('/') != std::string::npos; }

  /// `place` is "/full/path/library.so", which implements <dmpc/policy.h>, or "python:/full/path/file.py:Class", whose class has
  /// the methods in apps/python/dmpc/policies.py. The constructor starts the policy once to get its name. `check` is called
  /// while a policy is waited for, now and in runs, and may throw. Throws core::InputError that begins with "OPTION=PLACE: " for
  /// a file that others can write, a file that is not a policy or does not have this class, the name of one of dmpc's own
  /// policies, or a policy that does not start.
  ForeignPolicy(const std::string& option, const std::string& place, std::function<void()> check, PolicyPatience patience = {});

  /// Name of its column: printable, and different from dmpc's own policies.
  const std::string& name() const override { return name_; }

  /// Returns a node's faults for caches of several sizes, counted as in svm::policy_misses(). `prices`: of a miss of each
  /// reference; empty: 1. `check` is called continually and may throw, which ends the process. `fed` is called once per cache.
  /// Throws core::InputError for an error of the policy, with the call, the fault, the cache and the expected behaviour.
  std::vector<PricedFaults> misses(std::span<const svm::PageId> references, std::span<const std::uint32_t> cache_pages,
                                   std::uint32_t node, const std::function<void()>& check, const std::function<void()>& fed,
                                   std::span<const std::uint32_t> prices = {}) const;

  /// Starts a process for the caches of a run, which ends before this. Throws as misses() does, with the run's own check.
  std::unique_ptr<svm::OwnPolicyRun> start() const override;

 private:
  std::vector<std::string> answers(std::span<const svm::PageId> references, std::span<const std::uint32_t> prices,
                                   std::span<const std::uint32_t> cache_pages, std::uint32_t node,
                                   const std::function<void()>& check, const std::function<void()>& fed) const;

  PolicyPlace place_;
  std::function<void()> check_;
  std::string name_;
};

/// Throws core::InputError if two policies have the same name.
void check_names_differ(std::span<const ForeignPolicy> policies);

}  // namespace dmpc::apps
