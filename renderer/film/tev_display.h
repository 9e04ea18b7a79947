// Shows a picture in the viewer tev while it grows, over tev's own protocol: little-endian packets on a TCP connection,
// each beginning with its length and kind. Two kinds are used: CreateImage (4) once, UpdateImage (6, version 3:
// channels with offsets and strides) for each refresh.
#pragma once

#include "renderer/film/film.h"

#include <string>
#include <vector>

namespace moonshade::renderer {

class TevDisplay {
public:
  static constexpr const char* kHost = "127.0.0.1";
  static constexpr const char* kPort = "14158";

  TevDisplay() = default;
  ~TevDisplay();
  TevDisplay(const TevDisplay&) = delete;
  TevDisplay& operator=(const TevDisplay&) = delete;

  /// Connects to "HOST:PORT", "HOST", ":PORT" or the usual place where empty. Error, or empty.
  std::string connect(const std::string& place);
  /// Replaces the whole image of this name, which is made where it is new. Error, or empty; after an error the
  /// connection is closed.
  std::string show(const std::string& name, const Picture& picture);
  bool connected() const { return socket_ >= 0; }

  static std::string create_packet(const std::string& name, int width, int height);
  static std::string update_packet(const std::string& name, const Picture& picture);

private:
  std::string send_all(const std::string& bytes);

  int socket_ = -1;
  std::string place_, shown_;
  int width_ = 0, height_ = 0;
};

} // namespace moonshade::renderer
