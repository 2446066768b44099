// The output files of a command, each declared once: the option that names it, its check, and its contents.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/output_file.h"

namespace dmpc::apps {

/// Throws core::UsageError or core::InputError unless such a file can be made at the path; the message names the option.
using OutputCheck = void (*)(const std::filesystem::path&, std::string_view);

/// An output file's name without its contents, with which a set is checked.
struct OutputName {
  NamedFile file;
  OutputCheck check = check_output_path;
};

/// Throws core::UsageError or core::InputError unless all of them can be made, as far as can be known in advance, and none is the
/// same file as another or an input.
void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<OutputName>& outputs);

std::vector<NamedFile> files_of(const std::vector<OutputName>& outputs);

/// Throws core::InputError, which names `what` was to be written and adds `advice`, if the standard output does not accept data.
void check_standard_output(const std::string& what, const std::string& advice);

/// Throws ComputerCapacityError unless enough files can be open at a time to write the outputs.
void check_open_files();

/// Files that are written from a Result. Not thread-safe.
template <class Result>
class OutputSet {
 public:
  /// Writes the file's contents; nothing if something else writes the file.
  using Write = std::function<void(const Result&, std::ostream&)>;

  void add(std::string option, std::filesystem::path path, OutputCheck check, Write write) {
    names_.push_back({{std::move(option), std::move(path)}, check});
    writes_.push_back(std::move(write));
  }

  const std::vector<OutputName>& names() const { return names_; }

  /// Writes the files in the order in which they were added; a failure does not prevent later ones.
  void write(const Result& result, Attempts& attempts, Files& files = real_files()) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (writes_[i]) {
        attempts.make([&] {
          write_one(
              names_[i].file, [&](std::ostream& stream) { writes_[i](result, stream); }, files);
        });
      }
    }
  }

 private:
  static void write_one(const NamedFile& name, const std::function<void(std::ostream&)>& write, Files& files) {
    OutputFile file(name.path, {.option = name.name}, files);
    write(file.stream());
    file.commit();
  }

  std::vector<OutputName> names_;
  std::vector<Write> writes_;
};

}  // namespace dmpc::apps
