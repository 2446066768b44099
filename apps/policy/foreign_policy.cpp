#include "apps/policy/foreign_policy.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <optional>
#include <string_view>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/system/child_process.h"
#include "apps/frontend/system/companion_path.h"
#include "apps/frontend/system/memory_file.h"
#include "apps/frontend/system/trusted_path.h"
#include "apps/policy/request.h"
#include "core/base/expect.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {

/// The text of apps/python/dmpc/policies.py, embedded when dmpc is built, with which python3 is started.
extern const char* const policy_driver;

namespace {

constexpr std::string_view python = "python:";
constexpr std::size_t source_bytes_max = std::size_t{1} << 20U, said_bytes_max = std::size_t{1} << 20U,
                      complaint_bytes_max = 4000, name_bytes_max = 32;
constexpr const char* places = "expected /FULL/PATH/FILE.so or python:/FULL/PATH/FILE.py:CLASS";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_identifier(const std::string& text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

std::string read_source(int file) {
  std::string source;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = ::read(file, part.data(), part.size())) != 0;) {
    if (count < 0 && errno != EINTR) {
      throw core::InputError(std::string("it cannot be read: ") + std::strerror(errno));
    }
    source.append(part.data(), count < 0 ? 0 : static_cast<std::size_t>(count));
    if (source.size() > source_bytes_max) {
      throw core::InputError("it has more than a megabyte, expected the source of a class");
    }
  }
  return source;
}

void check_name(const std::string& name) {
  const bool is_printable = !name.empty() && name.size() <= name_bytes_max && std::all_of(name.begin(), name.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '.';
  });
  if (!is_printable) {
    throw core::InputError("the policy's name is not one that a column may have: expected 1 to 32 letters, digits, -, _ or .");
  }
  const auto kinds = svm::policy_kinds();
  if (name == "optimum" ||
      std::any_of(kinds.begin(), kinds.end(), [&](const svm::PolicyKind& kind) { return kind.name == name; })) {
    throw core::InputError("the policy's name, " + name + ", is that of a column that there is anyway: give it another one");
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
    lines.push_back(text.substr(at, end - at));
  }
  return lines;
}

/// Returns the last message of the process, or how it ended.
std::string complaint_of(const ChildProcess& process, int status) {
  std::string said = process.errors();
  said.resize(std::min(said.find_last_not_of(" \n") + 1, said.size()));
  if (said.size() > complaint_bytes_max) {
    said = "... " + said.substr(said.size() - complaint_bytes_max);
  }
  const std::string end = status < 0    ? "signal " + std::to_string(-status) + " ended it"
                          : status == 0 ? "it ended, as if all were well, before it had answered for every cache"
                                        : "it ended with status " + std::to_string(status);
  return said.empty() || status < 0 ? end + (said.empty() ? "" : ", having said: " + said) : said;
}

/// "12 340"
PricedFaults faults_in(const std::string& line) {
  const std::size_t blank = line.find(' ');
  const auto count = number_in<std::uint64_t>(line.substr(0, blank));
  const auto cost = blank == std::string::npos ? std::nullopt : number_in<std::uint64_t>(line.substr(blank + 1));
  if (!count || !cost) {
    throw core::InputError("its process tells what is no number of faults and no cost");
  }
  return {*count, *cost};
}

/// Reports every error of a policy with its name.
template <class Do>
auto reported_of(const std::string& place, const Do& made) {
  try {
    return made();
  } catch (const core::InputError& error) {
    throw core::InputError("--policy=" + place + ": " + error.what());
  }
}

}  // namespace

ForeignPolicy::ForeignPolicy(const std::string& place, const std::function<void()>& check) : place_(place) {
  reported_of(place, [&] {
    path_ = place;
    if (place.starts_with(python)) {
      const std::size_t colon = place.rfind(':');
      path_ = colon < python.size() ? "" : place.substr(python.size(), colon - python.size());
      class_name_ = place.substr(colon + 1);
    }
    if (!path_.starts_with('/') || (place.starts_with(python) && !is_identifier(class_name_))) {
      throw core::InputError(places);
    }
    const Descriptor file = open_trusted(path_);
    if (!class_name_.empty()) {
      source_ = read_source(file.number());
    }
    name_ = answers({}, {}, {}, 0, check, [] {}).front();
    check_name(name_);
  });
}

std::vector<PricedFaults> ForeignPolicy::misses(std::span<const svm::PageId> references,
                                                std::span<const std::uint32_t> cache_pages, std::uint32_t node,
                                                const std::function<void()>& check, const std::function<void()>& fed,
                                                std::span<const std::uint32_t> prices) const {
  return reported_of(place_, [&] {
    const std::vector<std::string> lines = answers(references, prices, cache_pages, node, check, fed);
    std::vector<PricedFaults> misses;
    std::transform(lines.begin() + 1, lines.end(), std::back_inserter(misses), faults_in);
    return misses;
  });
}

/// Messages are exchanged through memory files, so that neither side ever waits for the other to read them.
std::vector<std::string> ForeignPolicy::answers(std::span<const svm::PageId> references, std::span<const std::uint32_t> prices,
                                                std::span<const std::uint32_t> cache_pages, std::uint32_t node,
                                                const std::function<void()>& check, const std::function<void()>& fed) const {
  const MemoryFile request, answer;
  put_request(request, node, cache_pages, references, prices, source_);
  ChildSettings settings{
      .folder = "/", .gets_ctrl_c = false, .input = request.descriptor(), .output = answer.descriptor(), .leaves_nothing = true};
  if (class_name_.empty()) {
    settings.program =
        companion_path("dmpc_policy_host", "../libexec/dmpc", "the program dmpc_policy_host, which loads policies,");
    settings.arguments = {path_};
  } else {
    settings.program = "python3";
    settings.arguments = {"-I", "-X", "utf8", "-c", policy_driver, path_, class_name_};
  }
  ChildProcess process(settings);
  std::size_t reported = 0;
  const auto take = [&] {
    std::vector<std::string> lines = lines_of(answer.bytes());
    for (; reported + 1 < lines.size() && reported < cache_pages.size(); ++reported) {
      fed();
    }
    return lines;
  };
  std::optional<int> status;
  for (int backoff_ms = 1; !(status = process.status()); backoff_ms = std::min(2 * backoff_ms, 100)) {
    check();
    take();
    if (process.errors().size() > said_bytes_max || answer.bytes().size() > said_bytes_max) {
      throw core::InputError("it prints more than a megabyte, expected no more than a complaint");
    }
    ::poll(nullptr, 0, backoff_ms);
  }
  std::vector<std::string> lines = take();
  if (*status != 0 || lines.size() != 1 + cache_pages.size()) {
    throw core::InputError(complaint_of(process, *status));
  }
  return lines;
}

void check_names_differ(std::span<const ForeignPolicy> policies) {
  for (std::size_t i = 0; i < policies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (policies[i].name() == policies[j].name()) {
        throw core::InputError("--policy: two policies are called " + policies[i].name() + ": give one of them another name");
      }
    }
  }
}

}  // namespace dmpc::apps
