// The file of --trace: written before it gets its name.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/output_file.h"
#include "apps/stats.h"
#include "apps/trace_options.h"

namespace dmpc::apps {

/// Writes what the record's options ask for of its trace, if they do; removed again unless it is committed. Not thread-safe.
class TraceFile {
 public:
  /// Throws core::InputError if that fails.
  explicit TraceFile(const RenderRecord& record);

  /// Gives the file its name. Throws core::InputError if that fails.
  void commit();

 private:
  std::optional<OutputFile> file_;
};

/// A sentence on what was lost of a trace with these options, and which others leave room; empty if nothing was lost.
std::string loss_note(const nodes::Trace& trace, const TraceOptions& options);
/// A sentence on a trace without any activity or message; else empty.
std::string empty_note(const nodes::Trace& trace);

}  // namespace dmpc::apps
