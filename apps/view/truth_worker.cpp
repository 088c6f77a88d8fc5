// SPDX-License-Identifier: Apache-2.0
#include "truth_worker.h"

#include <algorithm>

namespace gnomon::view {

namespace {

/// One processor is left to the window, where there are several.
int thread_count() { return std::max(1, int(std::thread::hardware_concurrency()) - 1); }

void blend(base::Picture& mean, const base::Picture& added, float share)
{
    if (mean.empty()) {
        mean = added;
        return;
    }
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] += share * (added.values[i] - mean.values[i]);
}

} // namespace

TruthWorker::TruthWorker(const scene::Scene& scene, std::function<void()> wake)
    : scene_(scene)
    , wake_(std::move(wake))
    , thread_([this] { work(); })
{
}

TruthWorker::~TruthWorker()
{
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void TruthWorker::want(const Wish& wish)
{
    {
        const std::lock_guard lock(mutex_);
        if (wants_ && wish_.key == wish.key) return;
        wish_ = wish, wants_ = true;
        done_.clear();
    }
    changed_.notify_all();
}

void TruthWorker::rest()
{
    const std::lock_guard lock(mutex_);
    wants_ = false;
}

std::shared_ptr<const TruthWorker::Result> TruthWorker::newest() const
{
    const std::lock_guard lock(mutex_);
    return newest_;
}

bool TruthWorker::wanted(const std::string& key) const
{
    const std::lock_guard lock(mutex_);
    return !ends_ && wants_ && wish_.key == key;
}

void TruthWorker::publish(Result result)
{
    {
        const std::lock_guard lock(mutex_);
        newest_ = std::make_shared<const Result>(std::move(result));
    }
    wake_();
}

void TruthWorker::work()
{
    for (;;) {
        Wish wish;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return ends_ || (wants_ && done_ != wish_.key); });
            if (ends_) return;
            wish = wish_;
        }
        try {
            trace(wish);
        } catch (const std::exception& e) {
            Result failed;
            failed.key = wish.key, failed.finished = true, failed.error = e.what();
            publish(std::move(failed));
        }
        const std::lock_guard lock(mutex_);
        if (wish_.key == wish.key) done_ = wish.key;
    }
}

void TruthWorker::trace(const Wish& wish)
{
    const int threads = thread_count();
    if (!tracer_) tracer_ = std::make_unique<truth::Tracer>(scene_);
    if (!wanted(wish.key)) return;
    const truth::Primary primary = tracer_->primary(wish.view, threads);
    const bool soft = std::any_of(wish.lights.begin(), wish.lights.end(), [](const scene::Light& l) { return l.soft(); });
    Result result;
    result.key = wish.key, result.primitive = primary.primitive;
    result.images.resize(wish.lights.size());
    // One sample first, so that there is something to see at once; then more at a time, because strata of one pass are better than as many
    // passes, but few enough that a new view is not kept waiting.
    for (uint64_t pass = 0; result.samples < wish.samples && wanted(wish.key); ++pass) {
        const truth::Settings settings{.samples = pass == 0 ? 1 : pass < 5 ? 4 : 16, .seed = pass + 1, .threads = threads};
        for (size_t i = 0; i < wish.lights.size(); ++i) {
            if (pass > 0 && !wish.lights[i].soft()) continue;
            const truth::Visibility traced = wish.quantity == truth::Quantity::visibility
                ? tracer_->visibility(wish.view, primary, wish.lights[i], settings)
                : tracer_->transmittance(wish.view, primary, wish.lights[i], settings);
            blend(result.images[i], traced.mean, float(traced.samples) / float(result.samples + traced.samples));
            if (!wanted(wish.key)) return;
        }
        result.samples += settings.samples;
        result.finished = !soft || result.samples >= wish.samples;
        publish(result);
        if (!soft) return;
    }
}

} // namespace gnomon::view
