import js from "@eslint/js";
import globals from "globals";

const unused = { args: "after-used", ignoreRestSiblings: true, caughtErrors: "all" };

export default [
  { ignores: ["frontend/vendor/", ".venv/", "build/"] },
  js.configs.recommended,
  {
    languageOptions: { ecmaVersion: "latest", sourceType: "module", globals: globals.browser },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: { "no-unused-vars": ["error", unused], "max-len": ["error", 120] },
  },
  { files: ["frontend/**/*-worker.js"], languageOptions: { globals: globals.worker } },
  { files: ["frontend/**/*-worklet.js"], languageOptions: { globals: globals.audioWorklet } },
];
