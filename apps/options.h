// The command line as one struct a command.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "apps/check.h"
#include "apps/compare.h"
#include "apps/picture_options.h"
#include "svm/run.h"

namespace dmpc::apps {

/// Who finds what a ray hits: our grid, or Embree (with strategy replicated only).
enum class TracerChoice : std::uint8_t { grid, embree };

struct RenderOptions {
  PictureOptions picture;
  svm::Strategy strategy = svm::Strategy::svm;
  svm::RunOptions run;                 ///< progress is left unset
  std::size_t page_size_bytes = 1024;  ///< a power of two, 512 B to 64 KiB
  TracerChoice tracer = TracerChoice::grid;
  std::filesystem::path image;                 ///< where the picture goes
  std::optional<std::filesystem::path> stats;  ///< where the counters go, as JSON
  bool quiet = false;                          ///< no progress and no closing lines
};

struct SceneOptions {
  std::string name;                             ///< of a built-in scene
  std::optional<std::filesystem::path> output;  ///< stdout if not given
};

/// What `--help` or `--version` asks for.
struct HelpText {
  std::string text;
};

using Command = std::variant<HelpText, RenderOptions, SceneOptions, CheckOptions, CompareOptions>;

/// `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at the right --help, for
/// anything wrong that can be seen without reading a file.
Command parse_command_line(std::span<const std::string> arguments);

/// "300", "300B", "4KiB", "4MiB", "1GiB" in bytes. Throws core::UsageError naming `option` for anything else or more than 1 TiB.
std::size_t parse_size_bytes(std::string_view text, std::string_view option);

/// "512x384"; each 1 to 65536, at most 2^28 pixels. Throws core::UsageError for anything else.
Resolution parse_resolution(std::string_view text);

}  // namespace dmpc::apps
