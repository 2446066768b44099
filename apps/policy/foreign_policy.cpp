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
#include <utility>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/system/child_process.h"
#include "apps/frontend/system/memory_file.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "apps/frontend/system/trusted_path.h"
#include "apps/policy/foreign_run.h"
#include "apps/policy/request.h"
#include "core/base/expect.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {

namespace {

constexpr std::string_view python = "python:";
constexpr std::size_t source_bytes_max = std::size_t{1} << 20U, name_bytes_max = 32;
constexpr const char* expected_place = "expected /FULL/PATH/FILE.so or python:/FULL/PATH/FILE.py:CLASS";

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

/// For a memory file.
void write_all(int file, const void* from, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t written = ::write(file, static_cast<const char*>(from) + done, count - done);
    if (written < 0 && errno != EINTR) {
      throw ComputerCapacityError(std::string("the references cannot be kept in memory for a policy: ") + std::strerror(errno));
    }
    done += written < 0 ? 0 : static_cast<std::size_t>(written);
  }
}

}  // namespace

ForeignPolicy::ForeignPolicy(const std::string& option, const std::string& place, std::function<void()> check,
                             PolicyPatience patience)
    : place_{.option = option, .text = place, .path = place, .patience = patience}, check_(std::move(check)) {
  reported_of(place_, [&] {
    if (place.starts_with(python)) {
      const std::size_t colon = place.rfind(':');
      place_.path = colon < python.size() ? "" : place.substr(python.size(), colon - python.size());
      place_.class_name = place.substr(colon + 1);
    }
    if (!place_.path.starts_with('/') || (place.starts_with(python) && !is_identifier(place_.class_name))) {
      throw core::InputError(expected_place);
    }
    const Descriptor file = open_trusted(place_.path);
    if (!place_.class_name.empty()) {
      place_.source = read_source(file.number());
    }
    name_ = answers({}, {}, {}, 0, check_, [] {}).front();
    check_name(name_);
  });
}

std::unique_ptr<svm::OwnPolicyRun> ForeignPolicy::start() const { return std::make_unique<ForeignRun>(place_, check_); }

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
  put_request([&](const void* bytes, std::size_t count) { write_all(request.descriptor(), bytes, count); },
              {.node = node, .call_seconds = place_.patience.call_seconds}, cache_pages, references, prices, place_.source);
  core::expect(::lseek(request.descriptor(), 0, SEEK_SET) == 0, "a file in memory has a beginning");
  ChildProcess process(process_settings(place_, request.descriptor(), answer.descriptor()));
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
    check_says_little(process);
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
