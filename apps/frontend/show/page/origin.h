// The origin of a page: what a reader needs to reproduce its figures and to cite them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// As shown texts.
struct Origin {
  std::string command;   ///< quoted for a shell
  std::string program;   ///< name, version and build
  std::string date;      ///< "2026-11-22 21:40 UTC"
  std::string computer;  ///< its processors
  std::optional<std::uint64_t> scene_digest = {};
  std::vector<std::string> words = {};  ///< the command's words, quoted for a shell
};

/// The origin of what this process makes now. The date is that of SOURCE_DATE_EPOCH (seconds since 1970) where this is a number.
Origin this_origin(std::optional<std::uint64_t> scene_digest = {});

/// This process's command line; empty if the system does not give it.
std::vector<std::string> own_words();

/// Joins the words, quoted for a shell where needed; the program without its folder.
std::string command_text(std::span<const std::string> words);

/// Whether the text is one of these words, of any command, without control characters.
bool is_shell_word(std::string_view text);

/// In UTC, to the minute; `epoch` is the text of SOURCE_DATE_EPOCH, or nullptr.
std::string date_text(const char* epoch, std::int64_t now_seconds);

}  // namespace dmpc::apps
