// The protocol between dmpc and the processes that read and write files for it: kinds of messages with their fields.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dmpc::apps {

/// The version of the messages and their contents; processes of different builds are incompatible.
inline constexpr std::uint32_t protocol = 15;

/// The maximum size of a message; longer data are sent in pieces.
inline constexpr std::size_t message_bytes_max = 64 * 1024;
/// Longer texts are truncated.
inline constexpr std::size_t text_bytes_max = 32 * 1024;

/// Fields in the order in which they are packed (apps/reader/packing.h).
enum class Saying : std::uint8_t {
  // From dmpc.
  limits,     ///< bytes of memory: the first message
  read_mesh,  ///< path, bytes of memory for the scene, scale, up, smooth, size, flags of MeshOptions, and an animation's moment
              ///< if one is asked for
  read_texture,   ///< name, format hint, bytes of the file, whether alpha counts; with the file
  read_image,     ///< likewise
  weigh_picture,  ///< likewise; answered by picture and done, from the data before the pixels
  writes,         ///< an extension; answered by yes or no
  write_picture,  ///< name, width, height, whether its values are floats; these follow as bytes; answered by bytes, then done
  file,           ///< bytes of the file; with the file
  names,          ///< paths
  yes,
  no,  ///< the reason
  // From a reader.
  ready,          ///< protocol, its confinement: a flag each of Confinement
  open,           ///< path; answered by file or no
  exists,         ///< path; answered by yes or no
  meant,          ///< a folder and a name in the scene's file; answered by names
  progress,       ///< share, 0 to 1
  bytes,          ///< more of the current picture
  texture_file,   ///< whether it is only weighed, path, edges; answered by yes, when it is the scene's next texture, or no
  texture_bytes,  ///< number of bytes sent; the first time to be weighed: that, name, format hint, edges; answered likewise
  picture,        ///< width, height, format; its bytes follow, then done
  scene,          ///< view, background, counts of materials, objects, points, vertices, normals, corners, meshes and places
  lights,
  materials,
  objects,
  points,  ///< positions of vertices
  normals,
  corners,
  meshes,     ///< the objects that are base meshes: core::SharedMesh
  places,     ///< instances of meshes: core::Instance
  vertices,   ///< indices into the received points
  note,       ///< a text
  done,       ///< the last message of an answer
  bad_input,  ///< a text
  no_room,    ///< a text
  out_of_memory,
  lies_here,  ///< objects, or another list of a scene's, address and bytes: answered by yes, when dmpc has copied them, or no
  spheres,    ///< if the scene has spheres
  sky,        ///< the last of all: a picture's path, the rows that rotate the world's directions to its own, a factor
  bounds,     ///< for an animation's moment: a centre and a radius
  left_to_another,  ///< the requested picture: this program does not read it
};

}  // namespace dmpc::apps
