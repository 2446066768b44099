#include "apps/frontend/show/page/origin.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/real_load.h"

namespace dmpc::apps {

namespace {

/// The last second of the year 9999.
constexpr std::int64_t last_second = 253'402'300'799;

constexpr std::string_view plain_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,:/@%";

bool steers(unsigned char letter) { return letter < ' ' || letter == 0x7f; }

/// What would steer a terminal, or end a line, as the shells' $'...' has it (POSIX.1-2024).
std::string dollar_word(const std::string& word) {
  std::string quoted = "$'";
  for (const char letter : word) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '\'' || letter == '\\') {
      quoted += '\\';
    }
    if (steers(code)) {
      quoted += '\\';
      for (const unsigned shift : {6U, 3U, 0U}) {
        quoted += static_cast<char>('0' + (code >> shift & 7U));
      }
    } else {
      quoted += letter;
    }
  }
  return quoted + "'";
}

/// What it was made of; something else of what it does not make.
std::string word_of_dollar(std::string_view text) {
  std::string word;
  for (std::size_t i = 2; i + 1 < text.size(); ++i) {
    unsigned code = 0;
    if (text[i] != '\\') {
      word += text[i];
    } else if (const char* const digits = text.data() + i + 1;
               i + 4 < text.size() && std::from_chars(digits, digits + 3, code, 8).ptr == digits + 3) {
      word += static_cast<char>(code);
      i += 3;
    } else {
      word += text[++i];
    }
  }
  return word;
}

std::string shell_word(const std::string& word) {
  if (std::any_of(word.begin(), word.end(), steers)) {
    return dollar_word(word);
  }
  if (!word.empty() && word.find_first_not_of(plain_letters) == std::string::npos) {
    return word;
  }
  return in_quotes(word);
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) {
      return line.substr(std::min(line.size(), line.find(':') + 2));
    }
  }
  utsname system{};
  return ::uname(&system) == 0 ? system.machine : "unknown";
}

std::string build_text() {
#ifdef NDEBUG
  const std::string kind = "release";
#else
  const std::string kind = "debug";
#endif
#ifdef __clang__
  return kind + " build, " __VERSION__;
#else
  return kind + " build, GCC " __VERSION__;
#endif
}

/// Each as a shell takes it, the program without its folder.
std::vector<std::string> shell_words(std::span<const std::string> words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) {
    quoted.push_back(shell_word(quoted.empty() ? std::filesystem::path(word).filename().string() : word));
  }
  return quoted;
}

}  // namespace

std::vector<std::string> own_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) {
    words.push_back(word);
  }
  return words;
}

Origin this_origin(std::optional<std::uint64_t> scene_digest) {
  const std::vector<std::string> words = own_words();
  return {.command = command_text(words),
          .program = "dmpc " DMPC_VERSION " (" + build_text() + ")",
          .date = date_text(std::getenv("SOURCE_DATE_EPOCH"), std::time(nullptr)),
          .computer = counted(core_count(), "processor") + ", " + processor_name(),
          .scene_digest = scene_digest,
          .words = shell_words(words)};
}

std::string command_text(std::span<const std::string> words) { return joined(shell_words(words), " "); }

bool is_shell_word(std::string_view text) {
  if (text.starts_with("$'")) {
    const std::string word = word_of_dollar(text);
    return word.find('\0') == std::string::npos && dollar_word(word) == text && shell_word(word) == text;
  }
  constexpr std::string_view quote = "'\\''";
  const bool is_quoted = text.size() >= 2 && text.front() == '\'' && text.back() == '\'';
  std::string word;
  std::string_view rest = is_quoted ? text.substr(1, text.size() - 2) : text;
  while (!rest.empty()) {
    const bool is_quote = is_quoted && rest.starts_with(quote);
    word += rest.front();
    rest.remove_prefix(is_quote ? quote.size() : 1);
  }
  return shell_word(word) == text;
}

std::string date_text(const char* epoch, std::int64_t now_seconds) {
  std::int64_t seconds = 0;
  const char* const end = epoch == nullptr ? nullptr : epoch + std::strlen(epoch);
  const bool is_given = epoch != nullptr && std::from_chars(epoch, end, seconds).ptr == end && epoch != end && seconds >= 0 &&
                        seconds <= last_second;
  const std::time_t time = is_given ? seconds : now_seconds;
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  std::ostringstream text;
  text << std::put_time(&parts, "%Y-%m-%d %H:%M UTC");
  return text.str();
}

}  // namespace dmpc::apps
