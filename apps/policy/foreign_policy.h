// A replacement policy that is not dmpc's own: a class of Python's, or a shared library, each in a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "svm/pages/page.h"

namespace dmpc::apps {

/// A value. The policy's code runs in children of this process that know nothing but the references, and may crash, hang or end
/// without harm to it. Thread safety: an immutable value once made.
class ForeignPolicy {
 public:
  /// `place`: "/full/path/library.so" by <dmpc/policy.h>, or "python:/full/path/file.py:Class", whose class has the methods of
  /// apps/python/dmpc/policies.py. Starts it once, to have its name. `check` is called while that lasts, and may throw. Throws
  /// core::InputError that begins with "--policy=PLACE: " for a file that others can write, is no policy or has none of the name,
  /// a name of dmpc's own policies, or a policy that does not start.
  ForeignPolicy(const std::string& place, const std::function<void()>& check);

  /// Name of its column: printable, and different from dmpc's own policies.
  const std::string& name() const { return name_; }

  /// The faults of a node's caches of several sizes, each as svm::policy_misses() counts them. `check` is called all the time,
  /// and may throw: then the process is ended. `fed` is called once for each cache. Throws core::InputError for what the policy
  /// does wrong, naming call, fault and cache, and what was expected.
  std::vector<std::uint64_t> misses(std::span<const svm::PageId> references, std::span<const std::uint32_t> cache_pages,
                                    std::uint32_t node, const std::function<void()>& check,
                                    const std::function<void()>& fed) const;

 private:
  std::vector<std::string> answers(std::span<const svm::PageId> references, std::span<const std::uint32_t> cache_pages,
                                   std::uint32_t node, const std::function<void()>& check,
                                   const std::function<void()>& fed) const;

  std::string place_, path_, class_name_, source_, name_;
};

/// Throws core::InputError if two of them have one name.
void check_names_differ(std::span<const ForeignPolicy> policies);

}  // namespace dmpc::apps
