#include "apps/policy/policy_process.h"

#include <algorithm>

#include "apps/frontend/system/companion_path.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// The text of apps/python/dmpc/policies.py, embedded when dmpc is built, with which python3 is started.
extern const char* const policy_driver;

namespace {

constexpr std::size_t complaint_bytes_max = 4000;

}  // namespace

ChildSettings process_settings(const PolicyPlace& place, int input, int output) {
  ChildSettings settings{.folder = "/", .gets_ctrl_c = false, .input = input, .output = output, .leaves_nothing = true};
  if (place.class_name.empty()) {
    settings.program =
        companion_path("dmpc_policy_host", "../libexec/dmpc", "the program dmpc_policy_host, which loads policies,");
    settings.arguments = {place.path};
  } else {
    settings.program = "python3";
    settings.arguments = {"-I", "-X", "utf8", "-c", policy_driver, place.path, place.class_name};
  }
  return settings;
}

std::string complaint_of(const ChildProcess& process, int status) {
  std::string said = process.errors();
  said.resize(std::min(said.find_last_not_of(" \n") + 1, said.size()));
  if (said.size() > complaint_bytes_max) {
    said.replace(0, said.size() - complaint_bytes_max, "... ");
  }
  const std::string end = status < 0    ? "signal " + std::to_string(-status) + " ended it"
                          : status == 0 ? "it ended, as if all were well, before it had answered for every cache"
                                        : "it ended with status " + std::to_string(status);
  return said.empty() || status < 0 ? end + (said.empty() ? "" : ", having said: " + said) : said;
}

void check_says_little(const ChildProcess& process) {
  if (process.errors().size() > policy_says_bytes_max) {
    throw core::InputError("it prints more than a megabyte, expected no more than a complaint");
  }
}

}  // namespace dmpc::apps
