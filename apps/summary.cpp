#include "apps/summary.h"

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <ostream>
#include <sstream>
#include <string>

namespace dmpc::apps {

namespace {

/// 1234567 as 1,234,567.
std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t place = text.size(); place > 3; place -= 3) {
    text.insert(place - 3, 1, ',');
  }
  return text;
}

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string seconds_text(double seconds) { return fixed(seconds, seconds < 10 ? 3 : 1) + " s"; }

/// Rounded for people: 3.21 MiB.
std::string bytes_text(std::size_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (bytes < 1024) {
    return std::to_string(bytes) + " B";
  }
  return bytes < (std::size_t{1} << 20U) ? fixed(value / 1024, 1) + " KiB" : fixed(value / 1048576, 2) + " MiB";
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return fixed(whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole), 2) + " %";
}

std::string memory_text(const svm::Report& report) {
  const auto fullest = std::max_element(report.nodes.begin(), report.nodes.end(), [](const auto& a, const auto& b) {
    return a.memory_planned.total() < b.memory_planned.total();
  });
  std::string text = bytes_text(fullest->memory_planned.total()) + " a node:";
  for (std::size_t index = 0; index < nodes::category_count; ++index) {
    const std::size_t bytes = fullest->memory_planned.bytes[index];
    if (bytes > 0) {
      text +=
          std::string(index == 0 ? " " : ", ") + nodes::name_of(static_cast<nodes::Category>(index)) + " " + bytes_text(bytes);
    }
  }
  return text;
}

std::string rays_text(const core::Operations& operations, double render_seconds) {
  const auto count = [&](core::RayKind kind) { return grouped(operations.rays[static_cast<std::size_t>(kind)]); };
  const std::uint64_t total = std::accumulate(operations.rays.begin(), operations.rays.end(), std::uint64_t{0});
  const double rate = render_seconds > 0 ? static_cast<double>(total) / render_seconds : 0;
  return grouped(total) + " (primary " + count(core::RayKind::primary) + ", reflected " + count(core::RayKind::reflected) +
         ", refracted " + count(core::RayKind::refracted) + ", shadow " + count(core::RayKind::shadow) + "), " +
         grouped(static_cast<std::uint64_t>(rate)) + " a second";
}

std::string pages_text(const svm::Report& report) {
  const svm::PageCounters pages = report.pages();
  std::string text = grouped(pages.references) + " look-ups: at home " + percent(pages.home_hits, pages.references) +
                     ", cached " + percent(pages.cache_hits, pages.references) + ", missed " +
                     percent(pages.misses, pages.references) + "; " + grouped(pages.faults) + " faults, " +
                     grouped(pages.evictions) + " evictions";
  if (report.plan.request.count_pages) {
    const auto pixels = static_cast<double>(report.film.pixels().size());
    text += ", " + fixed(static_cast<double>(pages.distinct_pages) / pixels, 2) + " distinct pages a pixel";
  }
  return text;
}

}  // namespace

std::string dropped_text(std::uint64_t count) {
  if (count == 0) {
    return {};
  }
  return grouped(count) + (count == 1 ? " degenerate primitive was" : " degenerate primitives were") + " left out";
}

void print_summary(std::ostream& output, const RenderRecord& record) {
  const svm::Report& report = record.report;
  const svm::Plan& plan = report.plan;
  const bool paged = record.options.strategy == svm::Strategy::svm;
  const Seconds& seconds = record.seconds;
  output << "scene    " << record.options.picture.scene << ", " << grouped(record.database.header().primitive_count)
         << " primitives in " << grouped(record.database.page_count()) << " pages of "
         << svm::size_text(record.database.page_size()) << "\ncomputer " << report.nodes.size()
         << (report.nodes.size() == 1 ? " node, " : " nodes, ")
         << (paged ? "svm, " + grouped(plan.frames) + " cached pages a node, " : "replicated, ") << plan.in_flight
         << (plan.in_flight == 1 ? " pixel" : " pixels") << " in flight\nmemory   " << memory_text(report) << "\nrays     "
         << rays_text(report.operations(), seconds.render) << '\n';
  if (paged) {
    output << "pages    " << pages_text(report) << '\n';
  }
  output << "time     load " << seconds_text(seconds.load) << ", build " << seconds_text(seconds.build) << ", render "
         << seconds_text(seconds.render) << ", write " << seconds_text(seconds.write) << "; processor "
         << seconds_text(seconds.user + seconds.system) << "\npicture  " << record.options.image.string() << ", "
         << report.film.width() << "x" << report.film.height() << ", film " << hash_text(report.film.hash()) << '\n';
}

}  // namespace dmpc::apps
