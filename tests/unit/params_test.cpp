// SPDX-License-Identifier: Apache-2.0
#include "shadow/params.h"

#include "base/error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace gnomon::shadow {
namespace {

struct Params {
    int taps = 5;
    float bias = 0.1f;
    int filter = 1;
    int smooth = 1;
};

void describe(Params& p, Fields& fields)
{
    fields.integer("taps", p.taps, {1, 15}, "taps", "How many.");
    fields.real("bias", p.bias, {0, 2}, "m", "How far.");
    fields.choice("filter", p.filter, {"box", "tent", "gauss"}, "Which.");
    fields.flag("smooth", p.smooth, "Whether.");
}

ParamValues values() { return ParamValues(param_table(describe)); }

std::string message(const std::function<void()>& act)
{
    try {
        act();
    } catch (const base::Error& e) {
        return e.what();
    }
    return "no error";
}

#define EXPECT_SAYS(act, words) EXPECT_NE(message([&] { act; }).find(words), std::string::npos) << message([&] { act; })

TEST(Params, DefaultsAreTheStructAsItIsBorn)
{
    const ParamValues v = values();
    ASSERT_EQ(v.table().fields.size(), 4u);
    ASSERT_EQ(v.bytes().size(), sizeof(Params));
    Params out;
    std::memcpy(&out, v.bytes().data(), sizeof(out));
    EXPECT_EQ(out.taps, 5);
    EXPECT_EQ(out.bias, 0.1f);
    EXPECT_EQ(out.filter, 1);
    EXPECT_EQ(out.smooth, 1);
}

TEST(Params, SettingChangesThatFieldAlone)
{
    ParamValues v = values();
    v.set("taps", "7");
    v.set("bias", 0.25);
    v.set("filter", "gauss");
    v.set("smooth", "off");
    Params out;
    std::memcpy(&out, v.bytes().data(), sizeof(out));
    EXPECT_EQ(out.taps, 7);
    EXPECT_EQ(out.bias, 0.25f);
    EXPECT_EQ(out.filter, 2);
    EXPECT_EQ(out.smooth, 0);
    EXPECT_EQ(v.table().find("filter")->offset, offsetof(Params, filter));
    EXPECT_EQ(v.table().find("fitler"), nullptr);
}

TEST(Params, AForgottenFieldIsFound)
{
    EXPECT_THROW(param_table<Params>([](Params& p, Fields& f) {
        f.integer("taps", p.taps, {1, 15}, "", "");
        f.choice("filter", p.filter, {"box"}, "");
        f.flag("smooth", p.smooth, "");
    }),
        std::logic_error);
    EXPECT_THROW(param_table<Params>([](Params& p, Fields& f) {
        f.integer("taps", p.taps, {1, 15}, "", "");
        f.real("bias", p.bias, {0, 2}, "", "");
        f.choice("filter", p.filter, {"box"}, "");
    }),
        std::logic_error);
    EXPECT_THROW(param_table<Params>([](Params&, Fields&) {}), std::logic_error);
    EXPECT_THROW(param_table<Params>([](Params& p, Fields& f) {
        for (int i = 0; i < 4; ++i) f.integer("taps", p.taps, {1, 15}, "", "");
    }),
        std::logic_error);
}

TEST(Params, ValuesOutOfRangeStateTheRange)
{
    ParamValues v = values();
    EXPECT_SAYS(v.set("taps", "16"), "'taps' takes 1 to 15 taps, not 16");
    EXPECT_SAYS(v.set("taps", "0"), "1 to 15");
    EXPECT_SAYS(v.set("bias", -0.001), "0 to 2 m");
    EXPECT_SAYS(v.set("filter", 3.0), "0 to 2");
    EXPECT_SAYS(v.set("taps", "2.5"), "whole numbers");
    EXPECT_EQ(v.json(), values().json()) << "a refused value leaves the old one";
    v.set("bias", 2.0);
    v.set("bias", 0.0);
    v.set("taps", 15.0);
}

TEST(Params, WhatIsNoNumberIsRefused)
{
    ParamValues v = values();
    for (const char* text : {"nan", "-nan", "inf", "-inf", "1e999", "", "x", "0.5m", " 1", "0x1", "1,5"}) {
        EXPECT_SAYS(v.set("bias", text), "parameter 'bias' takes") << text;
        EXPECT_SAYS(v.set("taps", text), "parameter 'taps' takes") << text;
    }
    EXPECT_SAYS(v.set("bias", std::nan("")), "0 to 2 m");
    EXPECT_SAYS(v.set("taps", std::nan("")), "1 to 15");
    EXPECT_SAYS(v.set("smooth", "maybe"), "on or off");
    EXPECT_EQ(v.json(), values().json());
}

TEST(Params, UnknownNamesListTheNearOnes)
{
    ParamValues v = values();
    EXPECT_SAYS(v.set("tabs", "3"), "unknown parameter 'tabs'; did you mean 'taps'");
    EXPECT_SAYS(v.set("filter", "gaus"), "did you mean 'gauss'");
    EXPECT_SAYS(v.set("filter", "zzzzzz"), "choose one of box, tent, gauss");
    ParamValues none(no_params());
    EXPECT_SAYS(none.set("taps", "3"), "no parameters");
}

TEST(Params, TextAndJsonComeBackTheSame)
{
    for (const float bias : {0.1f, 0.0f, 2.0f, 1.0f / 3.0f, 1e-30f, 0x1p-149f}) {
        ParamValues v = values();
        v.set("taps", 11.0);
        v.set("bias", double(bias));
        v.set("filter", "box");
        v.set("smooth", 0.0);
        ParamValues by_text = values(), by_json = values();
        for (const ParamInfo& p : v.table().fields) by_text.set(p.name, std::string_view(v.text(p)));
        by_json.set_json(nlohmann::ordered_json::parse(v.json().dump()));
        EXPECT_TRUE(std::ranges::equal(by_text.bytes(), v.bytes())) << bias;
        EXPECT_TRUE(std::ranges::equal(by_json.bytes(), v.bytes())) << bias;
    }
    EXPECT_EQ(values().json().dump(), R"({"taps":5,"bias":0.1,"filter":"tent","smooth":true})");
}

TEST(Params, JsonOfAnotherFormIsRefused)
{
    using Json = nlohmann::ordered_json;
    ParamValues v = values();
    EXPECT_SAYS(v.set_json(Json::array({1})), "an object");
    EXPECT_SAYS(v.set_json(Json{{"taps", nullptr}}), "parameter 'taps' takes");
    EXPECT_SAYS(v.set_json(Json{{"taps", Json::array({3})}}), "parameter 'taps' takes");
    EXPECT_SAYS(v.set_json(Json{{"tabs", 3}}), "'taps'");
    EXPECT_SAYS(v.set_json(Json{{"bias", 1e300}}), "0 to 2");
    v.set_json(Json::object());
    EXPECT_EQ(v.json(), values().json());
}

} // namespace
} // namespace gnomon::shadow
