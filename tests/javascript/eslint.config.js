// The scripts of sim/view/web are put one after the other into one page, so each sees the names of the others; the
// type checker knows them, and reports names that no file defines.
import js from "@eslint/js";
import globals from "globals";

const rules = {
  ...js.configs.recommended.rules,
  eqeqeq: "error",
  "no-var": "error",
  "prefer-const": "error",
  "no-eval": "error",
  "no-implied-eval": "error",
  "object-shorthand": "error",
  "prefer-template": "error",
  "no-unused-vars": ["error", { argsIgnorePattern: "^_", caughtErrors: "none" }],
  "max-len": ["error", { code: 150, ignoreStrings: true, ignoreTemplateLiterals: true, ignoreRegExpLiterals: true }],
};

export default [
  { files: ["**/*.js"], languageOptions: { ecmaVersion: 2024, globals: globals.browser }, rules },
  {
    files: ["sim/view/web/*.js"],
    languageOptions: { sourceType: "script" },
    rules: { "no-undef": "off", "no-unused-vars": ["error", { vars: "local", argsIgnorePattern: "^_", caughtErrors: "none" }] },
  },
  { files: ["sim/view/web/live.js", "sim/view/web/order_game.js"], languageOptions: { sourceType: "module" } },
  { files: ["tests/javascript/*.js"], languageOptions: { globals: globals.node } },
];
