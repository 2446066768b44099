// The files of --heatmap: all written before any gets its name.
#pragma once

#include <list>

#include "apps/output_file.h"
#include "apps/stats.h"

namespace dmpc::apps {

/// Removed again unless they are committed. Not thread-safe.
class HeatFiles {
 public:
  /// Writes what record.options ask for; record.heat has their kinds. Throws core::InputError if that fails.
  explicit HeatFiles(const RenderRecord& record);

  /// Gives the files their names. Throws core::InputError if that fails.
  void commit();

 private:
  std::list<OutputFile> files_;  // which cannot be moved
};

}  // namespace dmpc::apps
