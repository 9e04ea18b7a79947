// What moonshade_images.so shows: file_images, by a name of C's.
#include "runtime/images/file_images.h"

extern "C" [[gnu::visibility("default")]] void moonshade_file_images(const moonshade::AllowedFolders& folders,
                                                                     moonshade::ImageOpener& opener) {
  opener = moonshade::file_images(folders);
}
