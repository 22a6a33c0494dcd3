# SPDX-License-Identifier: Apache-2.0
"""`relnav.driver.Bus` on hardware: registers in memory (memory_map), an AXI DMA (axi_dma), PYNQ (pynq)."""
