#include "apps/lab/study/policies.h"

namespace dmpc::apps {

void add_policies(OptionSet set, std::vector<std::string>& places) {
  set.add_texts(
      "--policy", "FILE.so|python:FILE.py:CLASS", [&places](const std::string& place) { places.push_back(place); },
      "A replacement policy of your own, beside dmpc's: a shared library by <dmpc/policy.h>, or a class in a file for Python, by "
      "its "
      "full path, which nobody but you and root can write; may be given several times");
}

std::vector<ForeignPolicy> load_policies(const std::vector<std::string>& places, const std::function<void()>& check) {
  std::vector<ForeignPolicy> policies;
  for (const std::string& place : places) {
    policies.emplace_back(place, check);
  }
  check_names_differ(policies);
  return policies;
}

}  // namespace dmpc::apps
