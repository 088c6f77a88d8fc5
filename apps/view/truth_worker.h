// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "scene/scene.h"
#include "truth/truth.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::view {

/// Traces the truth of one view in a thread of its own, a few samples more at a time, until it is told of another view or has enough.
class TruthWorker {
public:
    struct Wish {
        std::string key; ///< wishes of one key are the same
        scene::View view;
        std::vector<scene::Light> lights;
        truth::Quantity quantity = truth::Quantity::visibility;
        int samples = 1024; ///< a pixel and soft light, at most
    };
    struct Result {
        std::string key;
        std::vector<base::Picture> images; ///< one a light: 1 or 3 channels
        std::vector<uint32_t> primitive; ///< what the rays saw
        int samples = 0;
        bool finished = false;
        std::string error;
    };

    /// `scene` must outlive this; `wake` is called in the thread, after each new result.
    TruthWorker(const scene::Scene& scene, std::function<void()> wake);
    ~TruthWorker();
    TruthWorker(const TruthWorker&) = delete;
    TruthWorker& operator=(const TruthWorker&) = delete;

    void want(const Wish&); ///< begins anew where the key is another
    void rest(); ///< nothing is wanted
    std::shared_ptr<const Result> newest() const; ///< null before the first

private:
    void work();
    void trace(const Wish&);
    bool wanted(const std::string& key) const;
    void publish(Result);

    const scene::Scene& scene_;
    std::function<void()> wake_;
    std::unique_ptr<truth::Tracer> tracer_; ///< of the thread
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Wish wish_;
    bool wants_ = false, ends_ = false;
    std::string done_; ///< key of the wish that is finished
    std::shared_ptr<const Result> newest_;
    std::thread thread_; ///< last, so that all else is there when it begins
};

} // namespace gnomon::view
