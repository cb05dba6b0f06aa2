"""Problems: families of pose graphs, and the personal variants that are drawn from them."""
