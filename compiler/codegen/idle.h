// What takes long to make and waits, when a compilation has done with it, for the next one.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace moonshade::codegen {

/// The one thing that compilations share and change (docs/design.md says why it may be): which of several equal things
/// one gets must make no difference. To be made by `new` and never deleted: threads may give things back while the
/// process ends.
template <class T> class Idle {
public:
  /// Null where none waits.
  std::unique_ptr<T> take(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find(waiting_, key, &Waiting::first);
    if (found == waiting_.end()) return nullptr;
    std::unique_ptr<T> thing = std::move(found->second);
    waiting_.erase(found);
    return thing;
  }
  void give_back(std::string key, std::unique_ptr<T> thing) {
    std::unique_ptr<T> oldest; // whose end nobody need wait for
    const std::scoped_lock lock(mutex_);
    if (waiting_.size() >= kMost) {
      oldest = std::move(waiting_.front().second);
      waiting_.erase(waiting_.begin());
    }
    waiting_.emplace_back(std::move(key), std::move(thing));
  }

private:
  static constexpr size_t kMost = 8;
  using Waiting = std::pair<std::string, std::unique_ptr<T>>;
  std::mutex mutex_;
  std::vector<Waiting> waiting_;
};

} // namespace moonshade::codegen
