// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace gnomon::lab {

/// What the comments in GLSL sources say about structs, their members and resources: they are the only place that says it.
class Comments {
public:
    explicit Comments(const std::map<std::string, std::string>& sources);
    /// "" where there is none. `member` "": the struct or block itself.
    std::string of(const std::string& type, const std::string& member = "") const;
    std::string of_resource(const std::string& name) const { return of("", name); }

private:
    void read(const std::string& text);
    std::map<std::string, std::map<std::string, std::string>> by_type_;
};

} // namespace gnomon::lab
