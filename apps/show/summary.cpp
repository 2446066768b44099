#include "apps/show/summary.h"

#include <algorithm>
#include <ostream>
#include <variant>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/run/computer_capacity.h"
#include "apps/frontend/run/time_parts.h"
#include "apps/run/memory_categories.h"
#include "apps/run/ray_hops.h"
#include "apps/show/advice.h"
#include "nodes/size_text.h"

namespace dmpc::apps {

namespace {

/// Lines of one strategy only.
struct StrategyLines {
  std::string computer;  ///< the rest of that line
  std::string figures;   ///< whole lines, with their ends
  std::string advice;    ///< likewise
};

std::string memory_text(const Account& account) {
  const auto fullest = std::max_element(account.nodes.begin(), account.nodes.end(), [](const auto& a, const auto& b) {
    return a.memory_planned.total() < b.memory_planned.total();
  });
  std::string text = bytes_text(fullest->memory_planned.total()) + " a node:";
  const char* separator = " ";
  for (const auto& [category, name] : memory_categories) {
    const std::size_t bytes = fullest->memory_planned[category];
    if (bytes > 0) {
      text += separator + std::string(name) + " " + bytes_text(bytes);
      separator = ", ";
    }
  }
  return text;
}

/// Returns nothing where nodes have what they count.
std::string reference_text(const RenderRecord& record) {
  const nodes::ComputerRequest& computer = record.options.computer;
  const bool refer = !computer.machine && computer.immutable() == nodes::Immutable::is_referred_to;
  return refer && record.options.strategy != Strategy::dataflow
             ? "; pages are counted as copies, but lie in the host's database, " +
                   bytes_text(record.database.page_count() * record.database.page_size())
             : "";
}

/// Returns a whole line on the ranks and the traffic between them, or nothing.
std::string ranks_line(const Account& account) {
  if (account.ranks.empty()) {
    return "";
  }
  const auto fullest = std::max_element(account.ranks.begin(), account.ranks.end(), [](const auto& a, const auto& b) {
    return a.memory.network.total() < b.memory.network.total();
  });
  std::uint64_t packets = 0, frames = 0, bytes = 0;
  for (const nodes::RankFigures& rank : account.ranks) {
    packets += rank.traffic.packets_sent;
    frames += rank.traffic.frames_sent;
    bytes += rank.traffic.bytes_sent;
  }
  return "ranks    " + grouped(account.ranks.size()) + ", up to " + network_text(fullest->memory.network) +
         (account.ranks.size() == 1 ? "" : " each") + "; between them " + counted(packets, "packet") + " in " +
         counted(frames, "frame") + ", " + bytes_text(bytes) + "\n";
}

/// Returns the number of traversals: one for each ray, and one more in every region to which it travels.
std::uint64_t walks_of(const core::Operations& operations, const svm::Report&) { return operations.traced_ray_count(); }
std::uint64_t walks_of(const core::Operations& operations, const dataflow::Report& report) {
  return operations.traced_ray_count() + report.gathers().rays;
}

/// Returns nothing if all rays were traversed singly.
std::string bundles_text(const core::Operations& operations, std::uint64_t walks) {
  if (operations.bundles == 0) {
    return "";
  }
  const double width = static_cast<double>(operations.rays_in_bundles) / static_cast<double>(operations.bundles);
  return "; " + percent_text(percent_of(std::min(operations.rays_in_bundles, walks), walks), 1) + " in bundles of " +
         fixed(width, 1);
}

std::string rays_text(const core::Operations& operations, std::uint64_t walks, double render_seconds) {
  const auto count = [&](core::RayKind kind) { return grouped(operations.rays[static_cast<std::size_t>(kind)]); };
  const bool scatters = operations.rays[static_cast<std::size_t>(core::RayKind::scattered)] > 0;
  const std::string scattered = scatters ? ", scattered " + count(core::RayKind::scattered) : "";
  const std::uint64_t total = operations.ray_count();
  const double rate = render_seconds > 0 ? static_cast<double>(total) / render_seconds : 0;
  return grouped(total) + " (primary " + count(core::RayKind::primary) + ", reflected " + count(core::RayKind::reflected) +
         ", refracted " + count(core::RayKind::refracted) + ", shadow " + count(core::RayKind::shadow) + scattered + "), " +
         grouped(static_cast<std::uint64_t>(rate)) + " a second" + bundles_text(operations, walks);
}

std::string pages_text(const svm::Report& report) {
  const svm::PageCounters pages = report.pages();
  std::string text = grouped(pages.references) + " look-ups: at home " +
                     percent_text(percent_of(pages.home_hits, pages.references), 2) + ", cached " +
                     percent_text(percent_of(pages.cache_hits, pages.references), 2) + ", missed " +
                     percent_text(percent_of(pages.misses, pages.references), 2) + "; " + grouped(pages.faults) + " faults, " +
                     grouped(pages.evictions) + " evictions";
  if (report.plan.request.pages.count_pages) {
    const auto pixels = static_cast<double>(std::max<std::uint64_t>(report.work().pixels_rendered, 1));  // this run's
    text += ", " + fixed(static_cast<double>(pages.distinct_pages) / pixels, 2) + " distinct pages a pixel";
  }
  return text;
}

std::string questions_text(const svm::Report& report) {
  const svm::QuestionCounters questions = report.questions();
  const nodes::Traffic sent = report.sent()[number_of(svm::Kind::questions)];
  const double fill = sent.packets == 0 ? 0 : static_cast<double>(questions.answers) / static_cast<double>(sent.packets);
  return grouped(questions.rays_asked) + " about rays, " + grouped(questions.records_asked) + " about records, in " +
         counted(sent.packets, "packet") + " of " + fixed(fill, 1) + "; all answered";
}

/// Why a picture has a larger error than was requested.
std::string end_text(const RenderOptions& options, const core::RefinementResult& result) {
  if (result.is_cut_short) {
    return ", ended by --time: --passes=" + std::to_string(result.passes) + " in its place repeats the picture";
  }
  return result.passes == options.picture.refinement.passes && result.passes < core::passes_max
             ? ", more than requested: ended by --passes"
             : ", more than requested: no pixel may have more than --samples-max=" +
                   std::to_string(options.picture.refinement.samples_max);
}

/// Returns a whole line on adaptive sampling, or nothing.
std::string sampling_line(const RenderOptions& options, const Account& account) {
  if (!options.picture.is_refined) {
    return "";
  }
  const double mean = static_cast<double>(account.film.samples()) / static_cast<double>(account.film.pixel_count());
  const core::RefinementResult& result = account.refinement;
  return "samples  " + fixed(mean, 2) + " a pixel, in " + std::to_string(result.passes) +
         (result.passes == 1 ? " pass" : " passes") + "; estimated error " + fixed(255 * result.error, 3) + "/255" +
         (result.error > options.picture.refinement.error ? end_text(options, result) : "") + "\n";
}

/// Returns the text after the picture's name: the transport, if not the default, and samples chosen by default.
std::string picture_text(const PictureOptions& picture) {
  const std::string transport = picture.transport.is_by_paths() ? ", " + text_of(picture.transport) : "";
  const std::string error =
      std::string(", refined to the default error of ") + default_error(picture.transport.is_by_paths()).text;
  return transport + (picture.is_refined_unasked ? error : "") +
         (picture.is_by_paths_unasked  ? " (--transport=whitted for hard light)"
          : picture.is_refined_unasked ? " (--samples=1 for one ray a pixel)"
          : picture.is_one_ray_unasked ? " (one ray a pixel: --quality=good smooths edges)"
                                       : "");
}

StrategyLines lines_of(const RenderOptions& options, const svm::Report& report) {
  const bool paged = options.strategy == Strategy::svm;
  const std::string in_flight = counted(report.plan.in_flight, "pixel") + " in flight";
  if (options.strategy == Strategy::forest) {
    return {"forest of " + counted(report.plan.request.forest_page_count, "page") + ", " + in_flight,
            "asked    " + questions_text(report) + "\n"};
  }
  return {paged ? grouped(report.plan.frames) + " cached pages a node, " + in_flight : in_flight,
          paged ? "pages    " + pages_text(report) + "\n" : "", advice_lines(options, report)};
}

std::string travel_text(const dataflow::Report& report) {
  const dataflow::Gather::Counters sent = report.gathers();
  return grouped(sent.rays) + " messages, " + fixed(report.messages_per_ray(), 2) + " hops a ray, in " +
         counted(sent.packets, "packet") + " " + fixed(100 * report.mean_fill(), 1) + " % full; overflowed " +
         percent_text(percent_of(sent.rays_overflowed, sent.rays), 2);
}

std::string load_text(const dataflow::Report& report) {
  const auto average = [](const std::vector<double>& loads) { return fixed(100 * dataflow::average_load(loads), 1) + " %"; };
  const std::string predicted = report.predicted.empty() ? "" : "predicted " + average(report.predicted) + ", ";
  return predicted + "achieved " + average(report.work()) + " (mean over maximum of the nodes' work)";
}

std::string regions_text(const RenderOptions& options, const dataflow::Report& report) {
  const RayHops hops = ray_hops_of(report, *options.rays.topology);
  return fixed(report.duplication, 2) + " copies of a record; on the " + std::string(name_of(*options.rays.topology)) + " " +
         fixed(hops.mean, 2) + " links a message, " + fixed(hops.mean_of_random, 2) + " if mapped at random";
}

std::string places_text(const dataflow::Plan& plan) {
  return plan.shares_slots() ? counted(plan.ray_slots, "slot") + " a node, on request"
                             : counted(plan.ray_credits, "credit") + " a pair";
}

StrategyLines lines_of(const RenderOptions& options, const dataflow::Report& report) {
  return {counted(report.plan.ray_batch, "ray") + " a packet, " + places_text(report.plan) + ", " +
              counted(report.plan.queue_packets, "packet") + " queued",
          "travel   " + travel_text(report) + "\nload     " + load_text(report) + "\nregions  " + regions_text(options, report) +
              "\n"};
}

/// Returns the line about a host that was busy for more than half of the run; empty if it was not.
std::string host_line(const nodes::VirtualReport& report) {
  const double share = report.host_busy_share();
  return share <= 0.5 ? ""
                      : "host     busy for " + percent_text(100 * share) +
                            " of the run, mostly with film, so it may decide the time; with more samples a pixel nodes do\n";
}

/// Returns the lines of a run in virtual time, with line ends; none without it.
std::string virtual_lines(const RenderRecord& record, const Account& account) {
  const std::optional<nodes::Machine>& machine = record.options.computer.machine;
  if (!account.virtual_time || !machine) {
    return "";
  }
  const nodes::VirtualReport& report = *account.virtual_time;
  const std::string time = fixed(static_cast<double>(report.total_ns) / 1e9, 6) + " s on " + name_with_links(*machine);
  return "virtual  " + time + ", " + counted(report.events, "event") + "; run_hash " +
         hash_text(report.run_hash(record.film_hash())) + ", machine_digest " + hash_text(report.machine_digest) + "\nlosses   " +
         parts_text(parts_of(sum_of_nodes(report), account.waits), account.waits) + "\n" + host_line(report);
}

std::string time_text(const Seconds& seconds) {
  return "load " + seconds_text(seconds.load) + ", build " + seconds_text(seconds.build) + ", prepare " +
         seconds_text(seconds.prepare) + ", render " + seconds_text(seconds.render) + ", write " + seconds_text(seconds.write) +
         "; processor " + seconds_text(seconds.user + seconds.system);
}

}  // namespace

void print_summary(std::ostream& output, const RenderRecord& record) {
  const Account account = account_of(record.report);
  const StrategyLines special = std::visit([&](const auto& report) { return lines_of(record.options, report); }, record.report);
  const std::uint64_t walks = std::visit([&](const auto& report) { return walks_of(account.operations, report); }, record.report);
  output << "scene    " << shown(record.options.picture.scene) << ", "
         << counted(record.database.header().primitive_count, "primitive") << " in "
         << counted(record.database.page_count(), "page") << " of " << nodes::size_text(record.database.page_size())
         << "\ncomputer " << counted(account.nodes.size(), "node") << ", " << name_of(record.options.strategy) << ", "
         << special.computer << "\nmemory   " << memory_text(account) << reference_text(record) << '\n'
         << ranks_line(account) << "rays     " << rays_text(account.operations, walks, record.seconds.render) << '\n'
         << sampling_line(record.options, account) << special.figures << virtual_lines(record, account) << "time     "
         << time_text(record.seconds) << "\npicture  " << shown(record.options.image.string()) << ", " << account.film.width()
         << "x" << account.film.height() << ", film " << hash_text(record.film_hash()) << picture_text(record.options.picture)
         << '\n'
         << special.advice;
}

}  // namespace dmpc::apps
