// moonrender SCENE.lua|MODEL.obj [options] -o IMAGE: one picture, or one for each frame. The work is the library's.
#include "tools/moonrender/render_picture.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"
#include "tools/support/interrupt.h"

#include <csignal>
#include <new>

namespace moonshade::moonrender {

namespace {

int run(const Options& options) {
  Session session;
  if (std::string error = session.live.open(options); !error.empty())
    return fail(tools::kMachineAtFault, "moonrender: error: " + error);
  session.shaders = renderer::runtime_shaders(options.shaders);
  auto picture = [&](std::optional<int64_t> frame) {
    renderer::RenderProgress progress;
    session.progress = &progress;
    int status = render_picture(options, frame, session);
    tools::cancel_on_interrupt(nullptr);
    return status;
  };
  if (!options.frames) return picture(std::nullopt);
  int status = tools::kDone;
  for (int64_t frame = options.frames->first; frame <= options.frames->last && status == tools::kDone; ++frame)
    status = picture(frame);
  return status;
}

} // namespace

} // namespace moonshade::moonrender

int main(int argc, char** argv) {
  using namespace moonshade;
  tools::keep_standard_files_apart();
  tools::exit_on_interrupt();
  std::signal(SIGXFSZ, SIG_IGN); // a file beyond the allowed size is an error of writing, not the end
  moonrender::ParsedOptions parsed = moonrender::parse_options(argc, argv);
  if (!parsed.options) return parsed.exit_code;
  try {
    return moonrender::run(*parsed.options);
  } catch (const std::bad_alloc&) {
    return moonrender::fail(tools::kMachineAtFault, "moonrender: error: not enough memory");
  } catch (const std::exception& error) {
    return moonrender::fail(tools::kMachineAtFault, std::string("moonrender: internal error: ") + error.what());
  }
}
