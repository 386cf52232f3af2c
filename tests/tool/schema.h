// SPDX-License-Identifier: MIT
// Holds JSON files to a schema by Python's jsonschema, which nothing else needs.
#pragma once

#include "tests/tool/run.h"

#include <cstdlib>
#include <string>

namespace diptych {

inline bool hasValidator() {
    return std::system("python3 -c 'import jsonschema' 2>/dev/null") == 0;
}

// Runs `checks` in Python, with `schema`, its `validator`, and the file's contents as `data`.
inline Ran validate(const Folder& folder, const fs::path& schema, const fs::path& file,
                    const std::string& checks = "validator.validate(data)\n") {
    folder.write("validate.py", R"py(
import csv, json, math, sys, jsonschema
schema, data = (json.load(open(name)) for name in sys.argv[1:])
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
)py" + checks);
    return runShell(folder, "python3 validate.py '" + schema.string() + "' '" + file.string() + "'",
                    folder.path());
}

}  // namespace diptych
