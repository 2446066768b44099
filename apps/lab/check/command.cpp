#include "apps/lab/check/command.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <numeric>
#include <ostream>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/progress.h"
#include "apps/lab/check/inspection.h"
#include "apps/lab/oracle/places/place_judge.h"
#include "apps/lab/oracle/trial_line.h"
#include "apps/run/instance_options.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, core::ray_kind_count> kind_names{"primary", "reflected", "refracted", "shadow", "scattered"};
constexpr int unexplained_status = 3;

/// Counts of differences, of one kind of ray or of all.
struct Tally {
  std::uint64_t rays = 0, differences = 0, favours_grid = 0, favours_oracle = 0, unexplained = 0;
  std::array<std::uint64_t, verdict_count> verdicts{};

  void count(const Ruling& ruling) {
    ++differences;
    ++verdicts[static_cast<std::size_t>(ruling.verdict)];
    favours_grid += ruling.favours_grid ? 1 : 0;
    favours_oracle += ruling.favours_oracle ? 1 : 0;
    unexplained += explained(ruling.verdict) ? 0 : 1;
  }
};

constexpr int name_width = 10;
constexpr int number_width = 13;

template <class... Cells>
void print_row(std::ostream& output, const std::string& name, const Cells&... cells) {
  output << std::left << std::setw(name_width) << name << std::right;
  ((output << std::setw(number_width) << cells), ...);
  output << '\n';
}

void print_tally(std::ostream& output, const std::string& name, const Tally& tally) {
  const auto& verdicts = tally.verdicts;
  print_row(output, name, tally.rays, tally.differences, verdicts[0], verdicts[1], verdicts[2], verdicts[3], tally.favours_grid,
            tally.favours_oracle, tally.unexplained);
}

std::string answer_text(const Answer& answer, bool shadow) {
  if (!answer.hit || shadow) {
    return answer.hit ? "blocked" : shadow ? "free" : "miss";
  }
  return std::string("#").append(std::to_string(answer.primitive));
}

/// Prints a primitive named by an answer, as the referee sees it.
void print_named(std::ostream& output, const Referee& referee, const core::Ray& ray, const char* who, const Answer& answer) {
  if (!answer.hit || answer.primitive == core::no_primitive) {
    return;
  }
  const ExactIntersection seen = referee.examine(ray, answer.primitive);
  output << "    " << who << " #" << answer.primitive << ": t " << std::setprecision(9) << answer.t << ", referee's t "
         << std::setprecision(17) << seen.t << " +- " << std::setprecision(3) << seen.t_error << ", margin " << seen.margin[0]
         << " (grid's roundings), " << seen.margin[1] << " (Embree's)\n";
}

void print_doubtful(std::ostream& output, const Referee& referee, const core::Ray& ray) {
  for (const ExactIntersection& seen : referee.exact_intersections(ray)) {
    output << "    may block: #" << seen.primitive << " at t " << std::setprecision(17) << seen.t << " +- "
           << std::setprecision(3) << seen.t_error << " of " << std::setprecision(9) << ray.t_max << ", margin "
           << std::setprecision(3) << seen.margin[0] << ", " << seen.margin[1] << '\n';
  }
}

void print_difference(std::ostream& output, const Referee& referee, const SettledRay& settled, std::uint32_t width) {
  const core::Ray& ray = settled.traced.ray;
  const bool shadow = ray.kind == core::RayKind::shadow;
  const std::string exact = answer_text(settled.ruling.exact, shadow);
  output << "  " << pixel_text(ray.pixel, width) << " ray " << settled.traced.number << ", depth " << int{ray.depth} << ", "
         << kind_names[static_cast<std::size_t>(ray.kind)] << ": grid " << answer_text(settled.traced.grid, shadow) << ", Embree "
         << answer_text(settled.traced.oracle, shadow) << ", exactly " << exact << ": " << name_of(settled.ruling.verdict)
         << '\n';
  if (shadow) {
    print_doubtful(output, referee, ray);
  } else {
    print_named(output, referee, ray, "grid", settled.traced.grid);
    print_named(output, referee, ray, "Embree", settled.traced.oracle);
  }
}

/// Prints the first `most`, unexplained ones first.
void print_list(std::ostream& output, const Referee& referee, std::vector<SettledRay> rays, std::uint32_t most,
                std::uint32_t width) {
  std::stable_partition(rays.begin(), rays.end(), [](const SettledRay& ray) { return !explained(ray.ruling.verdict); });
  for (std::size_t index = 0; index < std::min<std::size_t>(most, rays.size()); ++index) {
    print_difference(output, referee, rays[index], width);
  }
}

std::uint64_t print_table(std::ostream& output, const Inspection& inspection) {
  print_row(output, "rays", "traced", "differ", "ties", "silhouettes", "ray ends", "oracle wrong", "grid exact", "oracle exact",
            "unexplained");
  Tally all;
  std::array<Tally, core::ray_kind_count> tallies{};
  for (const SettledRay& difference : inspection.differences) {
    tallies[static_cast<std::size_t>(difference.traced.ray.kind)].count(difference.ruling);
    all.count(difference.ruling);
  }
  for (std::size_t kind = 0; kind < core::ray_kind_count; ++kind) {
    tallies[kind].rays = inspection.operations.rays[kind];
    all.rays += tallies[kind].rays;
    print_tally(output, kind_names[kind], tallies[kind]);
  }
  print_tally(output, "all", all);
  return all.unexplained;
}

/// Returns rays on which both may agree although the referee rejects the answer.
std::vector<SettledRay> refused(const std::vector<SettledRay>& rays) {
  std::vector<SettledRay> result;
  std::copy_if(rays.begin(), rays.end(), std::back_inserter(result),
               [](const SettledRay& ray) { return !explained(ray.ruling.verdict); });
  return result;
}

std::uint64_t print_brute_force(std::ostream& output, const Inspection& inspection, const Referee& referee, std::uint32_t list,
                                std::uint32_t width) {
  if (inspection.brute_forced.empty()) {
    return 0;
  }
  const std::vector<SettledRay> bad = refused(inspection.brute_forced);
  const auto exact = std::count_if(inspection.brute_forced.begin(), inspection.brute_forced.end(),
                                   [](const SettledRay& ray) { return ray.ruling.favours_grid; });
  output << "Brute force: " << inspection.brute_forced.size() << " random rays against all primitives: " << exact
         << " answers of the grid exact, " << inspection.brute_forced.size() - static_cast<std::size_t>(exact) - bad.size()
         << " within rounding, " << bad.size() << " unexplained\n";
  print_list(output, referee, bad, list, width);
  return bad.size();
}

void print_failed(std::ostream& output, const CertifiedRay& ray, std::uint32_t width) {
  const TracedRay& traced = ray.traced;
  output << "  " << pixel_text(traced.ray.pixel, width) << " ray " << traced.number << ", "
         << kind_names[static_cast<std::size_t>(traced.ray.kind)] << ": #" << traced.hit.primitive << " at t "
         << std::setprecision(9) << traced.hit.t << ": " << name_of(ray.certified.fault) << '\n';
}

void print_spread(std::ostream& output, const char* what, const Spread& spread) {
  output << "  " << what << ": median " << std::setprecision(3) << spread.median() << " ulp, worst " << spread.worst()
         << " ulp\n";
}

/// Returns the number of certificates that fail.
std::uint64_t print_certified(std::ostream& output, const Inspection& inspection, std::uint32_t list, std::uint32_t width) {
  if (inspection.certified.empty()) {
    return 0;
  }
  CertifiedCounts counts;
  for (const CertifiedRay& ray : inspection.certified) {
    counts.count(ray.certified);
  }
  output << "Certificates: " << counts.hits << " random hits against rational arithmetic: " << counts.failures() << " fail, "
         << counts.undecided << " undecided, " << counts.inside << " surely on their primitive\n";
  print_spread(output, "interval of the exact t", counts.width_ulp);
  print_spread(output, "if surely on it, the hit's t is off by at most", counts.error_ulp);
  print_spread(output, "if surely on it, the kernels' bound allows", counts.allowed_ulp);
  for (const CertifiedRay& ray : inspection.certified) {
    if (ray.certified.fault != CertificateFault::none && list > 0) {
      print_failed(output, ray, width);
      --list;
    }
  }
  return counts.failures();
}

/// Prints how far the picture is the one that Embree would make.
void print_pixels(std::ostream& output, std::uint64_t differing, std::uint64_t pixels) {
  output << "Pixels that Embree would change: " << differing << " of " << pixels << ", "
         << fixed(1e6 * static_cast<double>(differing) / static_cast<double>(pixels), 1) << " ppm\n";
}

Inspection inspect_shown(const CheckOptions& options, const core::Database& database, const core::RenderSettings& settings) {
  const EmbreeScene embree(database.primitives(), EmbreeMode::robust);
  Progress progress(std::cerr, stderr_is_terminal());
  InspectionOptions inspection_options;
  inspection_options.brute_force = options.brute_force;
  inspection_options.certify = options.certify;
  inspection_options.progress = [&](std::uint64_t done, std::uint64_t total) { progress.update(done, total); };
  return inspect(database, embree, settings, inspection_options);
}

/// `failed`: certificates. The worst case is a failure, or the difference with the most involved explanation.
Trial trial_of(const Inspection& inspection, std::uint64_t unexplained, std::uint64_t failed, const PlaceFindings& places,
               std::uint32_t width) {
  std::vector<SettledRay> rays = refused(inspection.brute_forced);
  rays.insert(rays.end(), inspection.differences.begin(), inspection.differences.end());
  const auto& hits = inspection.certified;
  const auto& counts = inspection.operations.rays;
  const auto worst = std::ranges::max_element(rays, {}, [](const SettledRay& ray) { return ray.ruling.verdict; });
  const auto hit =
      std::ranges::find_if(hits, [](const CertifiedRay& ray) { return ray.certified.fault != CertificateFault::none; });
  Trial trial{.tried = {{std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}), "ray"},
                        {hits.size(), "certificate"},
                        {places.pixels, "place"}},
              .failed = {{unexplained, "unexplained ray"}, {failed, "certificate"}, {places.elsewhere, "place"}}};
  if (worst != rays.end() && (unexplained > 0 || failed + places.elsewhere == 0)) {
    trial.worst = name_of(worst->ruling.verdict);
    trial.where = pixel_text(worst->traced.ray.pixel, width);
  } else if (hit != hits.end()) {
    trial.worst = name_of(hit->certified.fault);
    trial.where = pixel_text(hit->traced.ray.pixel, width);
  } else if (places.elsewhere > 0) {
    trial.worst = places.worst;
    trial.where = places.where;
  }
  return trial;
}

std::uint64_t print_report(std::ostream& output, const CheckOptions& options, const Subject& subject,
                           const Inspection& inspection, const PlaceFindings& places) {
  const core::Database& database = subject.database;
  const core::Camera& camera = subject.settings.camera;
  const auto width = static_cast<std::uint32_t>(camera.width());
  output << options.picture.scene << ": " << database.primitives().size() << " primitives, " << width << "x" << camera.height()
         << " pixels, our " << name_of(subject.built.structure)
         << (database.header().has_instances != 0 ? " with base meshes" : "") << " against Embree " << embree_version()
         << " (robust)\n";
  const Referee referee(database);
  std::uint64_t unexplained = print_table(output, inspection);
  print_list(output, referee, inspection.differences, options.list, width);
  print_pixels(output, inspection.differing_pixels, camera.pixel_count());
  unexplained += print_brute_force(output, inspection, referee, options.list, width);
  const std::uint64_t failed = print_certified(output, inspection, options.list, width);
  if (places.pixels > 0 || !places.not_judged.empty()) {
    output << "The file's own positions, read by the oracle: " << text_of(places) << '\n';
  }
  output << line_of(trial_of(inspection, unexplained, failed, places, width)) << '\n';
  return unexplained + failed + places.elsewhere;
}

}  // namespace

void add_options(OptionSet options, CheckOptions& check) {
  add_options(options, check.picture);
  add_transport_options(options, check.picture);
  add_options(options, check.database);
  add_instance_option(options, check.database);
  options.check_in_the_end([options, &check] {
    check_voxels(options, check.database.build);
    settle_instances(options, {}, check.database, check.picture.scene_setup.mesh);
    check.picture.scene_setup.mesh.copies = core::Copies::put;  // for Embree and the referee, into whatever instance rays go
    if (check.picture.is_refined) {
      throw core::UsageError(
          "--samples=auto and --quality go with render and study; check traces a given number of samples per pixel");
    }
  });
  options.add_number("--list", check.list, 0, 1000000, "10", "Number of differences to print in full");
  options.add_number("--brute-force", check.brute_force, 0, std::int64_t{1} << 40U, "0",
                     "Number of rays to test against every primitive in double precision, too");
  options.add_flag_with_text("--certify", "100000", check.certify_text,
                             "Check the certificates of this many random hits against rational arithmetic: where the exact "
                             "answer lies and how far the kernels may be off");
  options.check_in_the_end([&check] {
    if (!check.certify_text.empty()) {
      check.certify = parse_seed(check.certify_text, "--certify");
    }
  });
  options.add_quiet(check.quiet);
  options.set_examples(
      "Examples:\n"
      "  dmpc check teapot-12\n"
      "  dmpc check tetra-9 --resolution=128x128 --brute-force=1000\n"
      "  dmpc check rings-3 --certify=1000000\n"
      "  dmpc check balls-4 --structure=voxels\n"
      "  dmpc check grove-4 --instances=keep\n"
      "The oracle reads the positions of faces and camera in glTF and OBJ files itself, too, and counts the pixels that see\n"
      "another place. The last line summarizes what was tried, what failed, the worst case and where it is.\n"
      "The exit status is 3 if a difference remains unexplained, a certificate does not hold, or a pixel sees another place.");
}

int check_command(const CheckOptions& options, Interrupt& interrupt, std::ostream& output) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  OpenedFiles opened;
  core::Scene scene = load_scene(options.picture, LoadNotes::said, &opened);
  const PlaceFindings places = options.picture.stored   ? PlaceFindings{.not_judged = "the scene is stored as its database"}
                               : opened.paths().empty() ? PlaceFindings{}
                                                        : judge_places(scene, options.picture, opened);
  const Subject subject = build_subject(std::move(scene), options.picture, options.database, true);
  const Inspection inspection = inspect_shown(options, subject.database, subject.settings);
  interrupt.set_consequence("the report is incomplete");
  const std::uint64_t failures = print_report(output, options, subject, inspection, places);
  finish_output(output, "the report");
  return failures == 0 ? 0 : unexplained_status;
}

}  // namespace dmpc::apps
