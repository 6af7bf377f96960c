"""The cheapest model that meets a tolerance."""
