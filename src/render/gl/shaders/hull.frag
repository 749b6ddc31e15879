// SPDX-License-Identifier: Apache-2.0
// Nothing is drawn: the stencil keeps which pixels the sector covers.
void main() {}
