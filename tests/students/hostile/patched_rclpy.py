"""Publishers and nodes of rclpy are replaced."""

# %% after square
import rclpy.node
import rclpy.publisher

rclpy.publisher.Publisher.publish = lambda self, message: None
rclpy.node.Node.create_publisher = lambda self, *arguments, **keywords: None
