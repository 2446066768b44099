#include "apps/frontend/show/trace/view.h"

#include <algorithm>
#include <map>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/work.h"
#include "svm/pages/packets.h"

namespace dmpc::apps {

using nodes::Activity;

std::string node_name(const TraceView& view, std::size_t index) {
  return index + 1 == view.trace.nodes.size() ? "host" : "node " + std::to_string(index);
}

SpanName name_of(const nodes::TraceSpan& span) {
  switch (span.activity) {
    case Activity::serve:
      return SpanName::serve_page;
    case Activity::send:
      return SpanName::send;
    case Activity::take_over:
      return SpanName::take_packet;
    default:
      break;
  }
  switch (doing_of(span.charged)) {
    case Doing::trace:
      return SpanName::trace;
    case Doing::shade:
      return SpanName::shade;
    case Doing::install:
      return SpanName::install_page;
    case Doing::pack:
      return span.activity == Activity::work ? SpanName::pack_rays : SpanName::unpack_rays;
    default:
      return SpanName::overhead;
  }
}

std::vector<const char*> TraceView::span_texts() const {
  std::vector<const char*> texts(activity_names.begin(), activity_names.end());
  texts.insert(texts.end(), operation_names.begin(), operation_names.end());
  return texts;
}

std::size_t TraceView::text_number(const nodes::TraceSpan& span) const {
  const bool is_call = span.activity != Activity::send && span.activity != Activity::take_over;
  for (std::size_t i = 0; is_call && i < operation_names.size(); ++i) {
    if (operation_names[i] != nullptr && (span.charged >> i & 1U) != 0) {
      return activity_names.size() + i;
    }
  }
  return static_cast<std::size_t>(name_of(span));
}

namespace {

/// Whether nothing was forgotten from a recorded time to another.
bool lie_together(const nodes::Trace& trace, std::uint64_t begin_ns, std::uint64_t end_ns) {
  return !trace.times || end_ns <= trace.times->end_of_stretch(begin_ns);
}

}  // namespace

std::vector<PageWait> page_waits(const TraceView& view) {
  std::vector<PageWait> waits;
  if (!view.has_pages) {
    return waits;
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> open;  // since when, by node and page
  for (const nodes::TraceMessage& message : view.trace.messages) {        // a reply is sent after its request
    if (message.kind == svm::number_of(svm::Kind::page_request)) {
      open[{nodes::index_of(message.source), message.first_word}] = message.sent_ns;
    } else if (message.kind == svm::number_of(svm::Kind::page_reply)) {
      const std::uint32_t node = nodes::index_of(message.target);
      if (const auto found = open.find({node, message.first_word}); found != open.end()) {
        if (lie_together(view.trace, found->second, message.received_ns)) {
          waits.push_back({node, message.first_word, found->second, message.received_ns});
        }
        open.erase(found);
      }
    }
  }
  return waits;
}

std::uint64_t end_ns(const nodes::Trace& trace) {
  std::uint64_t end = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    for (const nodes::TraceSpan& span : node.spans) {
      end = std::max(end, span.end_ns);
    }
  }
  for (const nodes::TraceMessage& message : trace.messages) {
    end = std::max(end, message.received_ns);
  }
  return end;
}

std::vector<TraceStretch> recorded_stretches(const nodes::Trace& trace) {
  std::vector<TraceStretch> stretches;
  if (!trace.times) {
    return stretches;
  }
  const nodes::RecordedTimes& times = *trace.times;
  const std::uint64_t last_ns = end_ns(trace);
  for (std::uint64_t at = times.has(0) ? 0 : times.next(0); at < last_ns;) {
    const std::uint64_t end = std::min(last_ns, times.end_of_stretch(at));
    stretches.push_back({at, end});
    at = times.has(end) ? end : times.next(end);
  }
  return stretches;
}

std::string thousandths(std::uint64_t value) {
  const std::string rest = std::to_string(value % 1000);
  return std::to_string(value / 1000) + "." + std::string(3 - rest.size(), '0') + rest;
}

std::string milliseconds(std::uint64_t time_ns) { return thousandths(time_ns / 1000); }

std::string lost_text(const nodes::Trace& trace) {
  const std::string events = counted(trace.events_lost, "event");
  const nodes::RecordedTimes& times = trace.times.value();
  if (!times.has_parts) {
    return "all is there from " + milliseconds(times.whole_from_ns) + " ms on, and " + events + " before were forgotten";
  }
  return "all is there until " + milliseconds(times.whole_until_ns) + " ms and from " + milliseconds(times.whole_from_ns) +
         " ms on, in between of each " + thousandths(times.period_ns()) + " us the first " + thousandths(times.part_ns()) +
         " us, and " + events + " were forgotten";
}

}  // namespace dmpc::apps
