#include "apps/run/instance_options.h"

#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// An option that prevents keeping base meshes, and the reason.
struct Hindrance {
  std::string option, reason;
};

std::optional<Hindrance> hindrance_of(const OptionSet& options, const RayTracers& tracers, const core::BuildOptions& build) {
  if (tracers.tested_objects > 0) {
    return Hindrance{"--tested-objects", "a list names leaves, and a leaf of a base mesh occurs in many instances"};
  }
  if (tracers.tracer == TracerChoice::embree) {
    return Hindrance{"--tracer=embree", "Embree has a copy for each instance"};
  }
  const bool is_open = !options.is_given("--structure") && !tracers.system;
  if (!is_open && build.structure != core::Structure::extents) {
    return Hindrance{
        tracers.system ? std::string("--system=") + name_of(*tracers.system)
                       : std::string("--structure=") + name_of(build.structure),
        std::string("base meshes are trees of boxes below one tree of all") +
            (tracers.system ? ", as svm-extents, replicated-extents, pixel-machine, forest and forest-static have them, and "
                              "--strategy=dataflow without --system"
                            : "")};
  }
  if (build.record_order != core::RecordOrder::spatial) {
    return Hindrance{"--record-order=scattered", "a base mesh is stored in one piece"};
  }
  return std::nullopt;
}

}  // namespace

void add_instance_option(OptionSet options, DatabaseOptions& database) {
  options.add_choice<InstancesChoice>(
      "--instances", database.instances,
      {{"expand", InstancesChoice::expand}, {"keep", InstancesChoice::keep}, {"auto", InstancesChoice::automatic}},
      "Meshes with several instances: expand: a copy for each. keep: one base mesh for all, which takes less memory (the same "
      "picture). auto: keep if no other option prevents it, less than half of the scene is then left to store and a tree has "
      "room");
}

void settle_instances(const OptionSet& options, const RayTracers& tracers, DatabaseOptions& database, MeshOptions& mesh) {
  if (database.instances == InstancesChoice::expand) {
    return;
  }
  const auto hindrance = hindrance_of(options, tracers, database.build);
  if (hindrance && database.instances == InstancesChoice::keep) {
    throw core::UsageError("--instances=keep does not go with " + hindrance->option + ": " + hindrance->reason +
                           "; --instances=expand makes a copy for each instance");
  }
  if (hindrance) {
    database.why_copied = hindrance->option;
    return;
  }
  mesh.copies = core::Copies::left_out;
  if (database.instances == InstancesChoice::keep) {
    database.store_instances();
  }
}

}  // namespace dmpc::apps
