#include "apps/show/frame_line.h"

#include <numeric>
#include <ostream>
#include <string>
#include <variant>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/shown_text.h"

namespace dmpc::apps {
namespace {

/// Nothing where all have all.
std::string travel_text(const svm::Report& report) {
  const std::uint64_t faults = report.pages().faults;
  const svm::QuestionCounters questions = report.questions();
  const std::uint64_t asked = questions.rays_asked + questions.records_asked;
  if (asked > 0) {
    return ", " + counted(asked, "question");
  }
  return report.plan.request.strategy->fetches_pages() ? ", " + counted(faults, "fault") : "";
}
std::string travel_text(const dataflow::Report& report) {
  const auto out = report.rays().out;
  return ", " + counted(std::accumulate(out.begin(), out.end(), std::uint64_t{0}), "ray") + " sent on";
}

std::string virtual_text(const Account& account, std::uint64_t film_hash) {
  return !account.virtual_time ? ""
                               : ", virtual " + seconds_text(static_cast<double>(account.virtual_time->total_ns) * 1e-9) +
                                     ", run_hash " + hash_text(account.virtual_time->run_hash(film_hash));
}

}  // namespace

void print_frame(std::ostream& output, std::uint64_t frame, const RenderRecord& record) {
  const Account account = account_of(record.report);
  output << "frame " << grouped(frame) << "  " << shown(record.options.image.string()) << ", film " << hash_text(record.film_hash)
         << std::visit([](const auto& report) { return travel_text(report); }, record.report) << ", "
         << bytes_text(nodes::total(account.sent).bytes) << " sent, " << seconds_text(record.seconds.render)
         << virtual_text(account, record.film_hash) << std::endl;  // seen at once, also in a file that somebody follows
}

}  // namespace dmpc::apps
