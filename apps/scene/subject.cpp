#include "apps/scene/subject.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/progress.h"
#include "apps/scene/database_facts.h"
#include "core/database/database.h"
#include "core/picture/ray_crowd.h"
#include "core/scene/base_meshes.h"
#include "core/scene/frame.h"

namespace dmpc::apps {

namespace {

/// `chose_copies`: --instances=auto chose copies.
core::CopyLimits copy_limits(const PictureOptions& picture, bool chose_copies) {
  core::CopyLimits limits{.bytes_max = reader_memory_bytes_max()};
  if (chose_copies) {
    limits.reason = "as --instances=auto has it here";
    limits.advice = "give --instances=keep";
  }
  if (picture.is_refined) {
    limits.corners_max = std::numeric_limits<std::uint64_t>::max();
    limits.reason = "among which --samples=auto looks for fine detail";
    limits.advice = chose_copies ? "give --instances=keep and a number of samples, such as --samples=4"
                                 : "give a number of samples, such as --samples=4";
  }
  return limits;
}

DatabaseOptions settled(DatabaseOptions options, const core::InstancingShare& share) {
  if (options.instances == InstancesChoice::automatic && options.why_copied.empty() && share.halves() && share.has_room()) {
    options.store_instances();
  }
  return options;
}

}  // namespace

Subject build_subject(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options, bool shows_progress) {
  Subject subject = build_subject_quietly(std::move(scene), picture, options, shows_progress);
  say_notes(notes_of(subject));
  return subject;
}

Subject build_subject_quietly(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options,
                              bool shows_progress) {
  return build_subject_of(scene, picture, options, shows_progress);
}

Subject build_subject_of(core::Scene& scene, const PictureOptions& picture, const DatabaseOptions& options, bool shows_progress) {
  Progress progress(std::cerr, shows_progress && stderr_is_terminal(), "Building:", "primitives");
  const core::InstancingShare share = core::instancing_share(scene);
  const core::BuildOptions built = settled(options, share).build;
  const bool chose_copies =
      options.instances == InstancesChoice::automatic && options.why_copied.empty() && !built.keeps_instances;
  core::BuildOptions build = built;
  build.emitters_max = picture.transport.emitters_max();
  build.for_paths = picture.transport.is_by_paths();
  build.progress = [&progress](std::uint64_t done, std::uint64_t total) { progress.update(done, total); };
  core::Database database = scene.stored != nullptr
                                ? stored_database(scene, picture, built)
                                : core::build_database(std::move(scene), build, copy_limits(picture, chose_copies));
  const core::RenderSettings settings = render_settings(picture, scene, database);
  const core::RoundingLoss loss = core::find_rounding_loss(database, settings.camera);
  const core::RecordCounts& records = database.records();
  const std::string emitters =
      emitters_text({database.header().emitter_count, records.emitters_met, records.emitters_covered}, picture.transport);
  const bool has_copies = database.primitives().size() == database.header().primitive_count;
  const std::string kept = instances_text(options, build.keeps_instances, database.records(), share) +
                           (has_copies ? "" : "; the effects of rounding were determined outside of these only");
  return {std::move(database), built, settings, loss, gain_text(scene.materials, picture.transport), emitters, kept};
}

void put_eye_far_away(core::Scene& scene, const core::Box& bounds) {
  if (!bounds.empty()) {
    scene.view.at = bounds.center();
    scene.view.from = bounds.center() + core::Vec3d{0, 0, 4 * core::far_eye_diagonals * length(bounds.high - bounds.low)};
    scene.view.up = {0, 1, 0};
  }
}

std::vector<std::string> notes_of(const Subject& subject) {
  return {dropped_text(subject.database.dropped()),
          loss_text(subject.loss),
          duplicates_text(subject.database.duplicates()),
          crowd_text(subject.settings.shade.one_child_from),
          subject.gain,
          subject.emitters,
          subject.kept};
}

void say_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (!note.empty()) {
      std::cerr << "dmpc: " << note << '\n';
    }
  }
}

std::string kept_text(const core::RecordCounts& records) {
  std::string copied;
  for (const auto& [obstacle, places] : records.copied) {
    copied += (copied.empty() ? "copied is what " : ", and what ") + std::string(text_of(obstacle)) + ", in " +
              counted(places, "place");
  }
  if (records.instances == 0) {
    return "no mesh is kept once: " + (copied.empty() ? "none of more than " + grouped(core::copied_triangles_max) +
                                                            " triangles stands in several places as the file has it"
                                                      : copied);
  }
  return "kept " + grouped(records.base_meshes) + (records.base_meshes == 1 ? " mesh" : " meshes") + " in " +
         counted(records.instances, "place") + ": " + counted(records.base_mesh_triangles, "triangle") + " for " +
         grouped(records.triangles_in_places) + (copied.empty() ? "" : "; " + copied);
}

std::string instances_text(const DatabaseOptions& options, bool keeps, const core::RecordCounts& records,
                           const core::InstancingShare& share) {
  if (!keeps && options.instances == InstancesChoice::expand) {
    return "";
  }
  if (keeps || share.places == 0) {
    return kept_text(records);
  }
  const std::string copied = "meshes have a copy in each of " + counted(share.places, "place") + ": ";
  if (!options.why_copied.empty()) {
    return copied + "none is kept once with " + options.why_copied;
  }
  if (share.halves()) {
    return copied + "beside places a tree has room for " + grouped(core::beside_places_max) +
           " primitives, and the scene has about " + grouped(share.own) + " that are in no mesh that is kept";
  }
  return copied + "with each once the scene would still take about " + grouped(share.stored / 3) + " triangles of " +
         grouped(share.seen / 3) + ", a place for two, and --instances=auto keeps them once below half of these";
}

std::string dropped_text(std::uint64_t count) {
  return count == 0 ? "" : counted(count, "degenerate primitive") + (count == 1 ? " was" : " were") + " left out";
}

std::string loss_text(const core::RoundingLoss& loss) {
  std::string text;
  if (loss.collapsed > 0) {
    text = counted(loss.collapsed, "primitive") + (loss.collapsed == 1 ? " is" : " are") +
           " left out, too small beside the scene " + "to have a size in its coordinates: up to " +
           rounded(loss.collapsed_pixels) + " pixels across";
  }
  if (loss.moved > 0) {
    text += (text.empty() ? "" : "; ") + counted(loss.moved, "primitive") + " may be off by up to " + rounded(loss.moved_pixels) +
            " pixels, as coordinates are rounded beside something so large";
  }
  if (loss.swapped > 0) {
    text += (text.empty() ? "" : "; ") + counted(loss.swapped, "face") +
            (loss.swapped == 1 ? " may show where another is" : " may show where others are") +
            " nearer, or be hidden, as they lie too close together to be told apart: up to " + rounded(loss.swapped_pixels) +
            " pixels across";
  }
  return text.empty() ? ""
                      : text + ": bring the scene's parts nearer to each other or nearer in size, or view it from farther away";
}

std::string crowd_text(std::uint8_t one_child_from) {
  const std::string depth = std::to_string(one_child_from), before = std::to_string(one_child_from - 1);
  return one_child_from == 0 ? ""
                             : "glass that mirrors, too, makes a sample trace more than " + grouped(core::crowd_rays) +
                                   " rays: from depth " + depth +
                                   " on each hit traces one of its two, chosen at random, so that the picture is right on "
                                   "average and noisy where such rays count; with --depth=" +
                                   before + " none is chosen";
}

std::string duplicates_text(std::uint64_t count) {
  return count == 0 ? "" : counted(count, "triangle") + (count == 1 ? " was" : " were") + " left out: there twice";
}

}  // namespace dmpc::apps
