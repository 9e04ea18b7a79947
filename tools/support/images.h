// Images for shaders of the command line: file_images (runtime/images), loaded when a shader has any.
#pragma once

#include "runtime/image.h"

#include <string>
#include <vector>

namespace moonshade::tools {

/// Opens the images of a shader: those in its own folder, in these and in folders below.
ImageOpener images_of(const std::string& shader, const std::vector<std::string>& folders = {});

} // namespace moonshade::tools
