// A scene as the nodes are given it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"
#include "core/database/database.h"
#include "core/picture/film/rounding_loss.h"
#include "core/picture/pixel_task.h"
#include "core/scene/base_meshes.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// What is rendered.
struct Subject {
  core::Database database;
  core::BuildOptions built;  ///< options of its database, with what the scene decides
  core::RenderSettings settings;
  core::RoundingLoss loss;  ///< loss of the picture by rounding coordinates
  std::string gain;         ///< gain_text() of its materials
  std::string emitters;     ///< emitters_text()
  std::string kept;         ///< instances_text()
};

/// The database of `scene`, whose objects are freed on the way, and its picture. Says on stderr what was left out or is off,
/// and with `shows_progress` how far it is if stderr is a terminal.
/// Throws core::InputError as core::build_database() does.
Subject build_subject(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options = {},
                      bool shows_progress = false);

/// Builds it without a word.
Subject build_subject_quietly(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options,
                              bool shows_progress = false);
/// What build_subject() says: sentences, some of which may be empty.
std::vector<std::string> notes_of(const Subject& subject);
/// Each on a line of stderr, unless it is empty.
void say_notes(const std::vector<std::string>& notes);

/// What is said of a database whose instances were to be kept: how many are, and what keeps the others from it.
std::string kept_text(const core::RecordCounts& records);

/// What is said of how often meshes are there; empty where nobody asked or none stands in several places. `keeps`: whether they
/// are kept.
std::string instances_text(const DatabaseOptions& options, bool keeps, const core::RecordCounts& records,
                           const core::InstancingShare& share);

/// A sentence about the primitives that a database left out; empty if it left out none.
std::string dropped_text(std::uint64_t count);
/// What is said about triangles that have the corners of others.
std::string duplicates_text(std::uint64_t count);

/// A sentence about a picture whose hits send one ray of two from this depth on; empty if that is 0.
std::string crowd_text(std::uint8_t one_child_from);

/// A sentence about what rounding takes from a picture, in pixels, and what to do; empty if that is nothing.
std::string loss_text(const core::RoundingLoss& loss);

}  // namespace dmpc::apps
