// The database and picture of a scene, as nodes receive them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"
#include "core/base/box.h"
#include "core/database/database.h"
#include "core/picture/film/rounding_loss.h"
#include "core/picture/pixel_task.h"
#include "core/scene/base_meshes.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct Subject {
  core::Database database;
  core::BuildOptions built;  ///< options of its database, after decisions that depend on the scene
  core::RenderSettings settings;
  core::RoundingLoss loss;  ///< effect of rounding coordinates on the picture
  std::string gain;         ///< gain_text() of its materials
  std::string emitters;     ///< emitters_text()
  std::string kept;         ///< instances_text()
};

/// Builds the database of `scene`, whose objects are freed in the process, and its render settings. Reports on stderr what was
/// left out or is inexact, and with `shows_progress` the progress if stderr is a terminal. Throws core::InputError as
/// core::build_database() does.
Subject build_subject(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options = {},
                      bool shows_progress = false);

/// Builds them without messages, or reads them if the scene is stored.
Subject build_subject_quietly(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options,
                              bool shows_progress = false);
/// Likewise, and leaves of the scene what its database does not have.
Subject build_subject_of(core::Scene& scene, const PictureOptions& picture, const DatabaseOptions& options, bool shows_progress);
/// Primitives are listed in cells with a pad that grows with the distance from which they are seen, up to a bound: with that of
/// an eye beyond it they are listed for every eye, and no picture has other bits.
void put_eye_far_away(core::Scene& scene, const core::Box& bounds);

/// Returns the messages of build_subject(): sentences, some of which may be empty.
std::vector<std::string> notes_of(const Subject& subject);
/// Prints each note that is not empty on a line of stderr.
void say_notes(const std::vector<std::string>& notes);

/// Describes a database that should store meshes once: how many it does, and what prevents the others.
std::string kept_text(const core::RecordCounts& records);

/// Describes how meshes with several instances are stored; empty if nobody asked or there are none. `keeps`: they are stored
/// once.
std::string instances_text(const DatabaseOptions& options, bool keeps, const core::RecordCounts& records,
                           const core::InstancingShare& share);

/// Describes the primitives that the database left out; empty if there are none.
std::string dropped_text(std::uint64_t count);
/// Describes triangles that have the corners of others.
std::string duplicates_text(std::uint64_t count);

/// Describes a picture whose hits send only one of two rays from this depth on; empty for 0.
std::string crowd_text(std::uint8_t one_child_from);

/// Describes the effect of rounding on the picture, in pixels, with advice; empty if there is none.
std::string loss_text(const core::RoundingLoss& loss);

}  // namespace dmpc::apps
