#include "apps/edge/show/trace/format.h"

#include "apps/edge/show/trace/chrome.h"
#include "apps/edge/show/trace/paje.h"
#include "apps/edge/show/trace/perfetto.h"

namespace dmpc::apps {

std::optional<TraceFile> trace_file_of(const std::filesystem::path& path) {
  const bool is_packed = path.extension() == ".gz";
  const std::filesystem::path ending = (is_packed ? path.stem() : path).extension();
  if (ending == ".json") {
    return TraceFile{TraceFormat::chrome, is_packed};
  }
  if (ending == ".pftrace") {
    return TraceFile{TraceFormat::perfetto, is_packed};
  }
  if (ending == ".paje") {
    return TraceFile{TraceFormat::paje, is_packed};
  }
  return std::nullopt;
}

void write_trace(const TraceView& view, TraceFormat format, std::ostream& output) {
  switch (format) {
    case TraceFormat::chrome:
      return write_chrome(view, output);
    case TraceFormat::perfetto:
      return write_perfetto(view, output);
    case TraceFormat::paje:
      return write_paje(view, output);
  }
}

}  // namespace dmpc::apps
