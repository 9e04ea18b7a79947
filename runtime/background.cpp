// A queue of jobs and at most one thread (background.h).
#include "runtime/background.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace moonshade {

struct BackgroundCompiler::State {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::function<void()>> jobs;
  bool working = false, ending = false;
  std::thread thread;

  /// Takes the next job; empty where none waits.
  std::function<void()> take() {
    if (jobs.empty()) return {};
    std::function<void()> job = std::move(jobs.front());
    jobs.pop_front();
    working = true;
    return job;
  }
  void end_job() {
    const std::scoped_lock lock(mutex);
    working = false;
    changed.notify_all();
  }
  void work() {
    for (;;) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return ending || !jobs.empty(); });
      if (ending) return;
      const std::function<void()> job = take();
      lock.unlock();
      job();
      end_job();
    }
  }
};

BackgroundCompiler::BackgroundCompiler(bool with_thread) : state_(std::make_unique<State>()) {
  if (with_thread) state_->thread = std::thread([state = state_.get()] { state->work(); });
}

BackgroundCompiler::~BackgroundCompiler() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ending = true;
    state_->changed.notify_all();
  }
  if (state_->thread.joinable()) state_->thread.join();
}

void BackgroundCompiler::wait() {
  std::unique_lock lock(state_->mutex);
  state_->changed.wait(lock, [&] { return state_->jobs.empty() && !state_->working; });
}

bool BackgroundCompiler::run_one() {
  std::function<void()> job;
  {
    const std::scoped_lock lock(state_->mutex);
    job = state_->take();
  }
  if (!job) return false;
  job();
  state_->end_job();
  return true;
}

void run_in_background(BackgroundCompiler& compiler, std::function<void()> job) {
  BackgroundCompiler::State& state = compiler.state();
  const std::scoped_lock lock(state.mutex);
  state.jobs.push_back(std::move(job));
  state.changed.notify_all();
}

} // namespace moonshade
