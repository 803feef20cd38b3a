// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A program among the sources, as such folders have them; it must not become part of the plugin.
int main() { return 0; }
